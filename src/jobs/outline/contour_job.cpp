// Draws outlines of a design, layer by layer.
#include "jobs/outline/contour_job.h"

#include <algorithm>
#include <cmath>

#include "base/system/steady_pace.h"
#include "base/system/stopwatch.h"
#include "base/system/tasks.h"
#include "base/text/text.h"
#include "questions/build.h"
#include "questions/design_stages.h"

namespace ombre::compile {
namespace {

constexpr int64_t most_corners = int64_t{1} << 30;  // limit for a layer
constexpr int64_t most_layers = int64_t{1} << 30;

Pitch chosen_height(const design::Design& design, const ContourRequest& request) {
  if (request.layer_height) return *request.layer_height;
  return design.sampling ? design.sampling->pitch[2] : default_layer_height;
}

// Returns the corners of cells in the plane of each layer.
voxel::Lattice corners_in_layers(const Box& box, Pitch cell, Pitch height, std::optional<double> z_mm) {
  voxel::Lattice lattice = corners_over(box, cell);
  lattice.pitch[2] = height;
  lattice.origin.z = z_mm ? *z_mm - 0.5 * height.mm() : box.lo.z;
  lattice.count[2] = z_mm ? 1 : voxel::voxels_along(box.size().z, height);
  return lattice;
}

std::string mm(double value) { return format_rounded(value, 6); }

bool is_sensible(const ContourPlan& plan, const ContourRequest& request, const SourceRange& where,
                 Diagnostics& diagnostics) {
  const Box& box = plan.box;
  if (request.z_mm && (*request.z_mm < box.lo.z || *request.z_mm > box.hi.z))
    diagnostics.error(Code::nothing_inside, where,
                      "z " + mm(*request.z_mm) + " mm is beside the part, which lies from z " + mm(box.lo.z) + " to " +
                          mm(box.hi.z) + " mm");
  else if (plan.corners.count[0] * plan.corners.count[1] > most_corners)
    diagnostics.error(Code::too_large, where,
                      "cells of " + mm(plan.corners.pitch[0].mm()) + " mm are too small for layers of this part",
                      "choose a larger " + spelled::option("--cell") + " or " + spelled::option("--tolerance"));
  else
    return true;
  return false;
}

bool is_high_enough(const Box& box, Pitch height, const SourceRange& where, Diagnostics& diagnostics) {
  if (box.size().z / height.mm() <= static_cast<double>(most_layers)) return true;
  diagnostics.error(Code::too_large, where,
                    "layers of " + height.text() + " mm are too thin for a part of " + mm(box.size().z) + " mm",
                    "choose a larger " + spelled::option("--layer-height"));
  return false;
}

LayerRegions regions_of(const ContourPlan& plan, surface::LayerOutline outline) {
  LayerRegions regions;
  for (const ContourRegion& region : plan.regions)
    regions.push_back(std::move(outline.regions[static_cast<size_t>(region.label) - 1]));
  return regions;
}

}  // namespace

std::optional<ContourPlan> plan_contours(const Loaded& loaded, const ContourRequest& request,
                                         Diagnostics& diagnostics) {
  const std::optional<Box> box = design_box(loaded.design, diagnostics);
  if (!box) return std::nullopt;
  const SourceRange where = loaded.design.parts[0].solid->where();
  const Pitch height = chosen_height(loaded.design, request);
  const auto fineness = choose_fineness(loaded.design, *box, request, diagnostics);
  if (!fineness || !is_high_enough(*box, height, where, diagnostics)) return std::nullopt;
  ContourPlan plan;
  plan.box = *box;
  plan.tolerance_mm = fineness->tolerance_mm;
  plan.corners = corners_in_layers(*box, fineness->cell, height, request.z_mm);
  if (!is_sensible(plan, request, where, diagnostics)) return std::nullopt;
  plan.memory_bytes = request.memory_bytes;
  const StageLoan loan{request.threads, request.memory_bytes, nullptr, request.stop};
  const design::Design design = with_stages(for_tolerance(loaded.design, fineness->tolerance_mm), loan);
  plan.stages = stages_of(design);
  auto program = build_regions(design, *box, request, diagnostics);
  if (!program) return std::nullopt;
  const auto colours = region_colours(design, *program, *box, diagnostics);
  for (size_t n = 0; n < program->regions.size(); ++n)
    if (!is_void(program->regions[n]))
      plan.regions.push_back({static_cast<surface::Label>(n + 1), program->regions[n], colours[n]});
  plan.partition = std::move(program->partition);
  return plan;
}

ContourWork size_contour_work(const ContourPlan& plan, int threads) {
  const auto stages = static_cast<double>(plan.stages->memory_bytes({threads, plan.memory_bytes, nullptr, nullptr}));
  // A corner has a label and, while it is computed, a number. Borders take little memory.
  const double layer = static_cast<double>(plan.corners.count[0]) * static_cast<double>(plan.corners.count[1]) *
                       (sizeof(surface::Label) + sizeof(float));
  const double allowed = (static_cast<double>(plan.memory_bytes) - stages) / layer;
  const int wanted = threads > 0 ? threads : core_count();
  ContourWork work{static_cast<int>(std::clamp(allowed, 1.0, static_cast<double>(wanted)))};
  work.memory_bytes = stages + layer * work.threads;
  return work;
}

void draw_contours(const ContourPlan& plan, int threads, const std::function<void(int64_t, const LayerRegions&)>& take,
                   Progress* progress, const StopFlag* stop) {
  plan.stages->prepare({threads, plan.memory_bytes, progress, stop});
  const ContourWork work = size_contour_work(plan, threads);
  const surface::Outliner outliner(plan.partition, plan.corners, plan.tolerance_mm);
  const auto layers = static_cast<size_t>(plan.layers());
  const Stopwatch watch;
  run_ordered<LayerRegions>(
      layers, work.threads, 2 * static_cast<size_t>(work.threads),
      [&](size_t n) { return regions_of(plan, outliner.layer(static_cast<int64_t>(n), stop)); },
      [&](size_t n, const LayerRegions& regions) {
        if (stop && stop->requested()) throw Cancelled();
        take(static_cast<int64_t>(n), regions);
        if (progress) progress->update(at_steady_pace(n + 1, layers, watch.seconds()));
      });
}

}  // namespace ombre::compile
