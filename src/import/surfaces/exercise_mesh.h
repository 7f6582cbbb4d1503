// Exercises a mesh that a reader returned, for fuzz targets; all calls are cheap.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "import/surfaces/corner_welder.h"
#include "import/surfaces/mesh_source.h"
#include "import/surfaces/shells.h"

namespace ombre::importing::test {

// Aborts if a guarantee of the readers or of the rows is violated.
inline void exercise(formats::Mesh mesh) {
  const auto require = [](bool condition) {
    if (!condition) std::abort();
  };
  require(!mesh.triangles.empty());
  for (const auto& triangle : mesh.triangles)
    for (const uint32_t i : triangle) require(i < mesh.vertices.size());
  require(mesh.texture_triangles.empty() || mesh.texture_triangles.size() == mesh.triangles.size());
  for (const auto& triangle : mesh.texture_triangles)
    for (const uint32_t i : triangle) require(i < mesh.texture_coordinates.size());
  size_t grouped = 0;
  for (const auto& group : mesh.groups) {
    require(group.first_triangle == grouped && group.triangle_count > 0);
    grouped += group.triangle_count;
  }
  require(grouped == mesh.triangles.size());

  formats::Mesh mended = mesh;
  if (weld_corners(mended, false)) require(inspect(mended).is_closed());
  if (inspect(mended).is_closed()) turn_inverted_shells(mended);
  const bool is_closed = inspect(mesh).is_closed();
  require(!is_closed || inspect(mended).is_closed());
  const auto source = make_mesh_source("fuzz", std::move(mesh), {});
  source->sample(0, source->bounds().center());
  // The lattice is 16 voxels across, whatever the size of the mesh.
  const Box box = source->bounds();
  const double pitch = std::max({box.size().x, box.size().y, box.size().z, 1e-300}) / 16;
  const Affine map = Affine::translation(box.lo) * Affine::scaling({pitch, pitch, pitch});
  const auto rows = source->rows(0, map);
  if (!rows) return;
  const auto* const winding = dynamic_cast<const RowWinding*>(rows.get());
  std::vector<std::vector<program::Span>> spans;
  for (int64_t k = -1; k <= 17; ++k) {
    rows->layer(k, -1, 17, 17, spans);
    std::vector<RowWinding::Crossing> crossings;
    winding->find_crossings(k, -1, 17, 17, crossings);
    int64_t sum = 0;
    for (const auto& crossing : crossings) sum += crossing.winding;
    require(!is_closed || sum == 0);
  }
}

}  // namespace ombre::importing::test
