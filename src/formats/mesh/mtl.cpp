#include "formats/mesh/mtl.h"

#include <algorithm>

#include "base/text/text.h"
#include "formats/containers/counted_warnings.h"
#include "formats/containers/text_scanner.h"

namespace ombre::formats {
namespace {

// Removes the first word of a text, and returns it.
std::string_view take_word(std::string_view& text) {
  const size_t end = std::min(text.find_first_of(" \t"), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  return word;
}

class MtlReader {
 public:
  MtlReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : scanner_(name, bytes, diagnostics, {'#', true}), name_(name), diagnostics_(diagnostics) {}

  std::vector<ObjMaterial> read() {
    while (!scanner_.at_end()) {
      read_statement(scanner_.word_in_line());
      scanner_.next_line();
    }
    warnings_.report(name_, diagnostics_);
    return std::move(materials_);
  }

 private:
  void read_statement(std::string_view keyword) {
    if (keyword == "newmtl") return start_material();
    if (materials_.empty()) return;
    if (keyword == "Kd") return read_colour(materials_.back().colour);
    if (keyword == "d") materials_.back().colour[3] = share();
    if (keyword == "Tr") materials_.back().colour[3] = 1 - share();
    if (keyword == "map_Kd") read_image(materials_.back().image);
  }

  void start_material() {
    materials_.emplace_back();
    materials_.back().name = scanner_.rest_of_line();
  }

  float share() { return static_cast<float>(std::clamp(scanner_.coordinate("a number from 0 to 1"), 0.0, 1.0)); }

  void read_colour(std::array<float, 4>& colour) {
    for (size_t n = 0; n < 3; ++n) colour[n] = share();
  }

  // Reads a file's name, behind options with their values.
  void read_image(MeshImage& image) {
    std::string text(scanner_.rest_of_line());
    std::string_view rest = trim(text);
    while (rest.starts_with('-')) {
      const std::string_view option = take_word(rest);
      rest = trim(rest);
      if (option == "-clamp") {
        if (take_word(rest) == "on") image.wrap_u = image.wrap_v = ImageWrap::clamp;
      } else if (option == "-s" || option == "-o" || option == "-t") {
        skip_numbers(rest);
        warnings_.add("an image is moved or scaled, which is not read",
                      "images are moved or scaled, which is not read");
      } else {
        take_word(rest);
        if (option == "-mm") take_word(rest);
      }
      rest = trim(rest);
    }
    image.name = rest;
    std::ranges::replace(image.name, '\\', '/');
  }

  static void skip_numbers(std::string_view& rest) {
    const auto is_number = [](std::string_view text) {
      return !text.empty() && text.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
    };
    for (int n = 0; n < 3; ++n) {
      std::string_view ahead = rest;
      if (!is_number(take_word(ahead))) return;
      rest = trim(ahead);
    }
  }

  TextScanner scanner_;
  const std::string& name_;
  Diagnostics& diagnostics_;
  CountedWarnings warnings_;
  std::vector<ObjMaterial> materials_;
};

}  // namespace

std::optional<std::vector<ObjMaterial>> read_mtl(const std::string& name, std::string_view bytes,
                                                 Diagnostics& diagnostics) {
  return read_or_null(name, bytes, diagnostics, [&] { return MtlReader(name, bytes, diagnostics).read(); });
}

std::vector<std::string> material_libraries(std::string_view obj) {
  constexpr std::string_view keyword = "mtllib";
  std::vector<std::string> names;
  for (size_t at = obj.find(keyword); at != std::string_view::npos; at = obj.find(keyword, at + 1)) {
    const std::string_view before = obj.substr(0, at), line = obj.substr(at, obj.find_first_of("\r\n", at) - at);
    const size_t line_begin = before.find_last_of("\r\n") + 1;
    if (!trim(before.substr(line_begin)).empty() || line.size() <= keyword.size()) continue;
    const std::string_view name = trim(line.substr(keyword.size()));
    if (!name.empty() && (line[keyword.size()] == ' ' || line[keyword.size()] == '\t')) names.emplace_back(name);
  }
  return names;
}

void apply_materials(const std::string& name, const std::vector<ObjMaterial>& materials, Mesh& mesh,
                     Diagnostics& diagnostics) {
  mesh.shadings.assign(mesh.triangles.size(), {});
  std::vector<int32_t> images(materials.size(), -1);
  for (const MeshGroup& group : mesh.groups) {
    const auto found = std::ranges::find(materials, group.material, &ObjMaterial::name);
    if (found == materials.end()) continue;
    const auto which = static_cast<size_t>(found - materials.begin());
    const bool has_image = !found->image.name.empty();
    if (has_image && mesh.texture_triangles.empty())
      fail(diagnostics, name, "the material \"" + found->name + "\" has an image, and the mesh no texture coordinates",
           "save it with texture coordinates");
    if (has_image && images[which] < 0) {
      images[which] = static_cast<int32_t>(mesh.images.size());
      mesh.images.push_back(found->image);
    }
    for (uint32_t n = 0; n < group.triangle_count; ++n) {
      TriangleShading& shading = mesh.shadings[group.first_triangle + n];
      shading.image = images[which];
      if (!has_image) shading.colours.fill(found->colour);
      for (size_t corner = 0; corner < 3 && has_image; ++corner)
        shading.places[corner] = mesh.texture_coordinates[mesh.texture_triangles[group.first_triangle + n][corner]];
    }
  }
}

}  // namespace ombre::formats
