#include "compile/mesh_job.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "compile/build.h"
#include "surface/contour.h"

namespace ombre::compile {
namespace {

// Corners begin so many cells before the box; an odd part, so that faces of round coordinates do not run through them.
constexpr double margin_cells = 1.37;

voxel::Lattice corners_over(const Box& box, Pitch cell) {
  voxel::Lattice lattice;
  lattice.pitch = {cell, cell, cell};
  const double h = cell.mm(), first = margin_cells + 0.5;  // the first corner is the centre of the first voxel
  lattice.origin = box.lo - Vec3{first * h, first * h, first * h};
  for (int axis = 0; axis < 3; ++axis)
    lattice.count[static_cast<size_t>(axis)] =
        static_cast<int64_t>(std::ceil(box.size()[axis] / h + 2 * margin_cells)) + 1;
  return lattice;
}

void add_bodies(const Loaded& loaded, const RegionProgram& program, const Box& box,
                const surface::RegionSurface& surface, MeshedDesign& made, Diagnostics& diagnostics) {
  const std::vector<design::Rgba> colours = region_colours(loaded.design, program, box, diagnostics);
  const size_t count = program.regions.size();
  for (size_t n = 0; n < count; ++n) {
    surface::Body body = surface::body_of(surface, static_cast<surface::Label>(n + 1));
    const Region& region = program.regions[n];
    if (body.triangles.empty() || is_void(region)) continue;
    const double share = count > 1 ? static_cast<double>(n) / static_cast<double>(count - 1) : 0;
    const double volume = surface::volume_mm3(body), area = surface::area_mm2(body);
    made.bodies.push_back({region, share, colours[n], std::move(body), volume, area});
  }
}

}  // namespace

std::optional<MeshedDesign> mesh_design(const Loaded& loaded, const MeshRequest& request, Diagnostics& diagnostics,
                                        Progress* progress, const StopFlag* stop) {
  const std::optional<Box> box = design_box(loaded.design, diagnostics);
  if (!box) return std::nullopt;
  const auto fineness = choose_fineness(loaded.design, *box, request, diagnostics);
  if (!fineness) return std::nullopt;
  const auto program = build_regions(loaded.design, *box, request, diagnostics);
  if (!program) return std::nullopt;
  MeshedDesign made;
  made.tolerance_mm = fineness->tolerance_mm;
  made.cell_mm = fineness->cell.mm();
  surface::ContourOptions options;
  options.corners = corners_over(*box, fineness->cell);
  for (size_t axis = 0; axis < 3; ++axis) made.cells[axis] = options.corners.count[axis] - 1;
  options.tolerance_mm = request.join_flat ? made.tolerance_mm : 0;
  options.threads = request.threads;
  const surface::RegionSurface surface = surface::contour(program->partition, options, progress, stop);
  made.report = surface.report;
  add_bodies(loaded, *program, *box, surface, made, diagnostics);
  return made;
}

}  // namespace ombre::compile
