#include "formats/slicers/project_filaments.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/math/box.h"
#include "base/text/text.h"
#include "formats/containers/xml_text.h"
#include "formats/slicers/slicer_settings.h"

namespace ombre::formats {
namespace {

// Types of filaments that slicers know, with their words for them. Longer words come first.
constexpr std::array<std::string_view, 12> filament_types{"PETG", "PVA",  "PLA", "PCTG", "ABS", "ASA",
                                                          "TPU",  "HIPS", "PET", "PC",   "PA",  "PP"};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

bool has_word(std::string_view text, std::string_view word) {
  for (size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const size_t end = at + word.size();
    if ((at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end]))) return true;
  }
  return false;
}

Filament filament_of(const MeshDocument& document, const MeshBody& body) {
  if (!body.material) return {body.name, MeshMaterial{}.colour, {}, {}};
  const MeshMaterial& material = document.materials[*body.material];
  return {material.name.empty() ? body.name : material.name, material.colour, {}, {}};
}

}  // namespace

std::vector<Filament> project_filaments(const MeshDocument& document) {
  if (!document.project.filaments.empty()) return document.project.filaments;
  std::vector<std::optional<Filament>> found(1);
  for (const MeshBody& body : document.bodies) {
    if (body.triangles.empty()) continue;
    const size_t extruder = std::clamp<size_t>(body_extruder(body), 1, most_filaments);
    found.resize(std::max(found.size(), extruder));
    if (!found[extruder - 1]) found[extruder - 1] = filament_of(document, body);
  }
  std::vector<Filament> filaments;
  for (size_t n = 0; n < found.size(); ++n)
    filaments.push_back(
        found[n].value_or(Filament{"filament " + std::to_string(n + 1), MeshMaterial{}.colour, {}, {}}));
  return filaments;
}

std::string filament_type(const Filament& filament) {
  const auto* const found =
      std::ranges::find_if(filament_types, [&](std::string_view type) { return has_word(filament.name, type); });
  return found == filament_types.end() ? "PLA" : std::string(*found);
}

std::vector<double> shares_of(const FilamentMixture& mixture) {
  double sum = 0;
  for (const FilamentMixture::Part& part : mixture.parts) sum += part.layers;
  std::vector<double> shares;
  for (const FilamentMixture::Part& part : mixture.parts) shares.push_back(part.layers / sum);
  return shares;
}

std::string opaque_colour(const Rgba& colour) { return hex_colour(std::span(colour).first(3)); }

std::string nozzle_temperature(const Filament& filament) {
  constexpr double usual = 200;
  return format_rounded(filament.temperature.value_or(usual), 6);
}

std::string flow_code(const Filament& filament) {
  return "M221 S" + format_rounded(100 * filament.flow.value_or(1), 4);
}

std::string placement_on_bed(const MeshDocument& document, double bed_mm) {
  Box box = Box::empty();
  for (const MeshBody& body : document.bodies)
    if (!body.triangles.empty())
      for (const Vec3& vertex : body.vertices) box = hull(box, Box{vertex, vertex});
  const Vec3 place =
      box.is_empty() ? Vec3{} : Vec3{bed_mm / 2, bed_mm / 2, 0} - Vec3{box.center().x, box.center().y, box.lo.z};
  std::string transform = "1 0 0 0 1 0 0 0 1";
  for (const double along : {place.x, place.y, place.z}) transform += ' ' + format_rounded(along, 9);
  return transform;
}

}  // namespace ombre::formats
