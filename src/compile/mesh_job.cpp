#include "compile/mesh_job.h"

#include "compile/build.h"
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
  MeshedDesign made;
  made.tolerance_mm = fineness->tolerance_mm;
  made.cell_mm = fineness->cell.mm();
  surface::ContourOptions options;
  options.corners = corners_over(*box, fineness->cell);
  options.tolerance_mm = made.tolerance_mm;
  options.join_flat = request.join_flat;
  options.threads = request.threads;
  const surface::RegionSurface surface = surface::contour(program->partition, options, progress, stop);
  made.report = surface.report;
  add_bodies(design, *program, *box, surface, made, diagnostics);
  return made;
}

}  // namespace ombre::compile
