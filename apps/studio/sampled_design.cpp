#include "studio/sampled_design.h"

#include <algorithm>
#include <cmath>

#include "load/find_printer.h"

namespace ombre::studio {
namespace {

// Returns the side of cubes of which about `voxels` fill the box.
Pitch pitch_for(const Box& box, double voxels) {
  const Vec3 size = box.size();
  const double least = std::max({size.x, size.y, size.z}) / 1000;
  const double sides = std::max(size.x, least) * std::max(size.y, least) * std::max(size.z, least);
  // Three digits are enough, and keep the lattice's arithmetic exact.
  const double side = std::cbrt(sides / voxels), unit = std::pow(10, std::floor(std::log10(side)) - 2);
  return Pitch::from_mm(std::ceil(side / unit) * unit).value_or(Pitch{});
}

}  // namespace

SampledDesign sample(const OpenDesign& design, const Box& box, double voxels, const StopFlag& stop,
                     const compile::GridQuery& query) {
  return sample(design, design.loaded, box, voxels, stop, query);
}

SampledDesign sample(const OpenDesign& design, const compile::LoadedPtr& form, const Box& box, double voxels,
                     const StopFlag& stop, const compile::GridQuery& query) {
  Diagnostics diagnostics;
  const auto printer = compile::find_printer("generic", diagnostics);
  if (!printer) throw design_error(diagnostics);
  compile::PlanOptions options;
  options.printer = *printer;
  options.pitch.fill(pitch_for(box, voxels));
  options.stop = &stop;
  options.memory = &design.memory;
  auto plan = compile::plan_over(form, box, options, diagnostics);
  if (!plan) throw design_error(diagnostics);
  const auto& count = plan->request.lattice.count;
  auto job = compile::plan_grids(form, *plan, query, {{0, 0, 0}, {count[0], count[1], count[2]}}, diagnostics);
  if (!job) throw design_error(diagnostics);
  return {std::move(*plan), std::move(*job)};
}

}  // namespace ombre::studio
