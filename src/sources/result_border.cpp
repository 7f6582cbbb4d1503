#include "sources/result_border.h"

#include <algorithm>
#include <filesystem>

#include "base/text/file_ending.h"
#include "formats/results/result_formats.h"
#include "import/fields/result_mesh.h"

namespace ombre::sources {

bool has_elements(const std::string& path) {
  return std::ranges::any_of(formats::result_formats(), [&](const formats::ResultFormat& format) {
    return format.has_elements && has_ending(path, format.file);
  });
}

std::string numbers_beside(const std::string& path) {
  std::filesystem::path beside(path);
  if (ending_of(beside) != ".xdmf") return "";
  std::error_code ignored;
  return std::filesystem::exists(beside.replace_extension(".h5"), ignored) ? beside.string() : "";
}

std::optional<formats::Mesh> result_border(const std::string& name, std::string_view bytes,
                                           const formats::ResultsBeside& beside, double deform,
                                           Diagnostics& diagnostics) {
  auto results = formats::read_results(name, bytes, beside, diagnostics);
  if (!results) return std::nullopt;
  if (!results->kinds.empty() && deform != 0 && !formats::deform(*results, deform)) {
    diagnostics.error({make_source(name, ""), 0, 0}, "the file has no displacement of all nodes that could deform it");
    return std::nullopt;
  }
  return border_of_elements(name, std::move(*results), diagnostics);
}

std::optional<formats::Mesh> border_of_elements(const std::string& name, formats::Results results,
                                                Diagnostics& diagnostics) {
  if (results.kinds.empty()) {
    diagnostics.error({make_source(name, ""), 0, 0}, "the file has no elements that enclose space");
    return std::nullopt;
  }
  const importing::ResultMesh elements(std::move(results));
  formats::Mesh mesh;
  std::vector<uint32_t> places(elements.results().points.size(), UINT32_MAX);
  for (const importing::BorderTriangle& triangle : elements.border()) {
    std::array<uint32_t, 3> corners{};
    for (size_t n = 0; n < 3; ++n) {
      uint32_t& place = places[triangle.points[n]];
      if (place == UINT32_MAX) {
        place = static_cast<uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(elements.results().points[triangle.points[n]]);
      }
      corners[n] = place;
    }
    mesh.triangles.push_back(corners);
  }
  if (mesh.triangles.empty()) {
    diagnostics.error({make_source(name, ""), 0, 0}, "the elements have no outer sides: each is there twice");
    return std::nullopt;
  }
  mesh.groups.push_back({"", 0, static_cast<uint32_t>(mesh.triangles.size())});
  return mesh;
}

}  // namespace ombre::sources
