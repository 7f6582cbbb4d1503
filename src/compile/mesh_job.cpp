#include "compile/mesh_job.h"

#include <algorithm>

#include "base/text.h"
#include "compile/build.h"
#include "surface/cell_grid.h"
#include "surface/contour.h"

namespace ombre::compile {
namespace {

void add_bodies(const design::Design& design, const RegionProgram& program, const Box& box,
                const surface::RegionSurface& surface, MeshedDesign& made, Diagnostics& diagnostics) {
  const std::vector<design::Rgba> colours = region_colours(design, program, box, diagnostics);
  const size_t count = program.regions.size();
  for (size_t n = 0; n < count; ++n) {
    const Region& region = program.regions[n];
    if (is_void(region)) continue;
    surface::Body body = surface::body_of(surface, static_cast<surface::Label>(n + 1));
    if (body.triangles.empty()) continue;
    const double share = count > 1 ? static_cast<double>(n) / static_cast<double>(count - 1) : 0;
    const double volume = surface::volume_mm3(body), area = surface::area_mm2(body);
    made.bodies.push_back({region, share, colours[n], std::move(body), volume, area});
  }
}

// The number of cells at a surface grows with the square of their fineness.
MeshPlan plan_mesh(const RegionProgram& program, const Box& box, const Fineness& fineness, int threads) {
  constexpr double cells_of_look = 48;
  const Vec3 size = box.size();
  const double fine = fineness.cell.mm(), longest = std::max({size.x, size.y, size.z});
  Pitch cell = fineness.cell;
  if (const auto coarse = Pitch::from_mm(longest / cells_of_look); coarse && coarse->mm() > fine) cell = *coarse;
  const auto mixed = surface::find_mixed_cells(program.partition.label, corners_over(box, cell), threads);
  const double finer = cell.mm() / fine;
  MeshPlan plan{fineness.tolerance_mm, fine, static_cast<double>(mixed.cells().size()) * finer * finer, 0};
  plan.memory_bytes = plan.cells * surface::bytes_per_mixed_cell;
  return plan;
}

// False, and a diagnostic, when it is clearly too much. What is close is decided when the cells are known.
bool fits(const MeshPlan& plan, const MeshRequest& request, const Loaded& loaded, Diagnostics& diagnostics) {
  constexpr double doubt = 1.5;
  const auto allowed = static_cast<double>(request.memory_bytes);
  if (request.memory_bytes == 0 || plan.memory_bytes <= doubt * allowed) return true;
  diagnostics.error({loaded.source, 0, 0},
                    "cells of " + format_rounded(plan.cell_mm, 3) + " mm, about " +
                        format_count(static_cast<unsigned long long>(plan.cells)) + " at the surface, take about " +
                        format_bytes(plan.memory_bytes) + " of memory, more than the " + format_bytes(allowed) +
                        " allowed",
                    "choose a larger --cell or --tolerance, or more --memory");
  return false;
}

}  // namespace

std::optional<MeshedDesign> mesh_design(const Loaded& loaded, const MeshRequest& request, Diagnostics& diagnostics,
                                        Progress* progress, const StopFlag* stop) {
  const std::optional<Box> box = design_box(loaded.design, diagnostics);
  if (!box) return std::nullopt;
  const auto fineness = choose_fineness(loaded.design, *box, request, diagnostics);
  if (!fineness) return std::nullopt;
  const design::Design design = for_tolerance(loaded.design, fineness->tolerance_mm);
  const auto program = build_regions(design, *box, request, diagnostics);
  if (!program) return std::nullopt;
  const MeshPlan plan = plan_mesh(*program, *box, *fineness, request.threads);
  if (request.announce) request.announce(plan);
  if (!fits(plan, request, loaded, diagnostics)) return std::nullopt;
  MeshedDesign made;
  made.tolerance_mm = fineness->tolerance_mm;
  made.cell_mm = fineness->cell.mm();
  surface::ContourOptions options;
  options.corners = corners_over(*box, fineness->cell);
  options.tolerance_mm = made.tolerance_mm;
  options.join_flat = request.join_flat;
  options.threads = request.threads;
  options.memory_bytes = request.memory_bytes;
  const surface::RegionSurface surface = surface::contour(program->partition, options, progress, stop);
  made.report = surface.report;
  add_bodies(design, *program, *box, surface, made, diagnostics);
  return made;
}

}  // namespace ombre::compile
