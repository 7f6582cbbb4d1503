#include "jobs/mesh/painted_surfaces.h"

#include <algorithm>
#include <map>

#include "base/text/text.h"
#include "formats/containers/xml_text.h"
#include "formats/slicers/flavour.h"
#include "formats/slicers/slicer_settings.h"
#include "jobs/mesh/vertex_colours.h"
#include "questions/question.h"
#include "questions/sampler.h"

namespace ombre::jobs {
namespace {

using compile::Sampler;

// Points of a triangle that are sampled: its centre, and the middles between it and the corners.
constexpr size_t points_of_triangle = 4;

// Returns points of all triangles, which lie a little inside, since materials have a meaning there alone.
std::vector<Vec3> sample_points(const formats::MeshBody& body, double inward_mm) {
  std::vector<Vec3> points;
  for (const auto& [a, b, c] : body.triangles) {
    const Vec3 corners[] = {body.vertices[a], body.vertices[b], body.vertices[c]};
    const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double size = length(normal);
    const Vec3 inward = size > 0 ? (-inward_mm / size) * normal : Vec3{};
    const Vec3 centre = (1.0 / 3) * (corners[0] + corners[1] + corners[2]) + inward;
    points.push_back(centre);
    for (const Vec3& corner : corners) points.push_back(0.5 * (centre + corner + inward));
  }
  return points;
}

double area_of(const formats::MeshBody& body, size_t triangle) {
  const auto& [a, b, c] = body.triangles[triangle];
  return 0.5 * length(cross(body.vertices[b] - body.vertices[a], body.vertices[c] - body.vertices[a]));
}

// Names and colours of filaments, by what the samples say.
class Palette {
 public:
  Palette(const design::MaterialTable& materials, const Sampler& sampler, bool is_of_materials)
      : materials_(materials), sampler_(sampler), is_of_materials_(is_of_materials) {}

  // Returns the filament of a sample, counted from 0 in the order in which they occur.
  size_t filament_of(const std::vector<std::vector<double>>& columns, size_t sample) {
    formats::Filament filament = is_of_materials_ ? of_material(columns, sample) : of_colour(columns, sample);
    const auto [known, is_new] = numbers_.try_emplace(filament.name, filaments_.size());
    if (is_new) filaments_.push_back(std::move(filament));
    return known->second;
  }
  const std::vector<formats::Filament>& filaments() const { return filaments_; }

 private:
  formats::Filament of_material(const std::vector<std::vector<double>>& columns, size_t sample) const {
    size_t most = 0;
    for (size_t c = 1; c < columns.size(); ++c)
      if (columns[c][sample] > columns[most][sample]) most = c;
    const design::Material& material = materials_.all()[sampler_.columns()[most].material];
    return {material.name, material.colour, {}, {}};
  }

  static formats::Filament of_colour(const std::vector<std::vector<double>>& columns, size_t sample) {
    formats::Filament filament;
    for (size_t part = 0; part < 3; ++part) filament.colour[part] = compile::colour_byte(columns[part][sample]);
    filament.name = formats::hex_colour(std::span(filament.colour).first(3));
    return filament;
  }

  const design::MaterialTable& materials_;
  const Sampler& sampler_;
  bool is_of_materials_;
  std::vector<formats::Filament> filaments_;
  std::map<std::string, size_t> numbers_;
};

class SurfacePainter {
 public:
  SurfacePainter(const Sampler& sampler, Palette& palette, double inward_mm, int threads, const StopFlag* stop)
      : sampler_(sampler), palette_(palette), inward_mm_(inward_mm), threads_(threads), stop_(stop) {}

  // Returns false when there are more filaments than a project can have.
  bool paint(formats::MeshBody& body) {
    const std::vector<Vec3> points = sample_points(body, inward_mm_);
    std::vector<std::vector<double>> columns(sampler_.columns().size(), std::vector<double>(points.size()));
    std::vector<double*> to;
    for (auto& column : columns) to.push_back(column.data());
    sampler_.sample(points, to, threads_, stop_);
    std::vector<double> areas(formats::most_filaments);
    for (size_t t = 0; t < body.triangles.size(); ++t) {
      const size_t filament = palette_.filament_of(columns, points_of_triangle * t);
      bool is_divided = false;
      for (size_t n = 1; n < points_of_triangle; ++n)
        is_divided = palette_.filament_of(columns, points_of_triangle * t + n) != filament || is_divided;
      if (palette_.filaments().size() > formats::most_filaments) return false;
      const double area = area_of(body, t);
      areas[filament] += area;
      whole_mm2_ += area;
      if (is_divided) divided_mm2_ += area;
      body.paint.push_back(static_cast<uint8_t>(filament + 1));
    }
    formats::set_extruder(body, static_cast<size_t>(std::ranges::max_element(areas) - areas.begin()) + 1);
    return true;
  }

  void tell(const Events& events) const {
    std::vector<std::string> names;
    DataList reported;
    for (const formats::Filament& filament : palette_.filaments()) {
      names.push_back(filament.name);
      reported.push_back(filament.name);
    }
    events.say("the surface is painted with " + join(names, ", "));
    events.event("painting", {{"filaments", reported}, {"area_mm2", whole_mm2_}, {"divided_mm2", divided_mm2_}});
    constexpr double much = 0.02;
    if (divided_mm2_ <= much * whole_mm2_) return;
    events.warn(
        format_rounded(100 * divided_mm2_ / whole_mm2_, 2) +
        " % of the surface lies in triangles that have several of these filaments, and each triangle gets one; " +
        spelled::option("--keep-all") + " or a smaller " + spelled::option("--cell") + " makes them finer");
  }

 private:
  const Sampler& sampler_;
  Palette& palette_;
  double inward_mm_;
  int threads_;
  const StopFlag* stop_;
  double whole_mm2_ = 0, divided_mm2_ = 0;
};

void report(Diagnostics& diagnostics, const compile::Loaded& loaded, const std::string& message) {
  diagnostics.error(Code::option, {loaded.source, 0, 0}, message,
                    "write " + spelled::option("--colour-by", "materials") + ", or leave " +
                        spelled::option("--flavour") + " out for colours of vertices");
}

}  // namespace

bool paint_surfaces(const compile::Loaded& loaded, const std::string& by, double inward_mm, const Events& events,
                    formats::MeshDocument& document, Diagnostics& diagnostics, int threads, const StopFlag* stop) {
  const bool is_of_materials = by == "materials";
  compile::SampleQuery query;
  query.fractions = is_of_materials;
  if (!is_of_materials) query.attributes = compile::attribute_parts(loaded.design, by);
  const auto sampler = Sampler::build(loaded.design, query, diagnostics);
  if (!sampler) return false;
  if (!is_of_materials && sampler->columns().size() < 3) {
    report(diagnostics, loaded, "\"" + by + "\" is a number, and slicers paint surfaces with filaments");
    return false;
  }
  Palette palette(loaded.design.materials, *sampler, is_of_materials);
  SurfacePainter painter(*sampler, palette, inward_mm, threads, stop);
  for (formats::MeshBody& body : document.bodies) {
    if (painter.paint(body)) continue;
    report(diagnostics, loaded,
           "the surface has more than " + std::to_string(formats::most_filaments) + " colours by \"" + by +
               "\", and a project has at most that many filaments");
    return false;
  }
  document.project.filaments = palette.filaments();
  painter.tell(events);
  return true;
}

}  // namespace ombre::jobs
