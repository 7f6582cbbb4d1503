// Draws outlines of a design, layer by layer: of the whole, or of its regions.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/system/progress.h"
#include "load/loaded.h"
#include "questions/region_request.h"
#include "stages/job_stages.h"
#include "surface/outline/outline.h"

namespace ombre::compile {

struct ContourRequest : RegionRequest {
  std::optional<Pitch> layer_height;      // default: the design's own, else default_layer_height
  std::optional<double> z_mm;             // middle of a single layer; default: all layers, as slicing has them
  int threads = 0;                        // 0: all cores
  const StopFlag* stop = nullptr;         // must live as long as the plan
  size_t memory_bytes = size_t{2} << 30;  // for layers in flight and stages; one at a time is always allowed
};
constexpr Pitch default_layer_height{1, 10};

struct ContourRegion {
  surface::Label label = 0;
  Region region;
  design::Rgba colour{};
};

struct ContourPlan {
  Box box;  // box of the design
  double tolerance_mm = 0;
  surface::Partition partition;
  std::vector<ContourRegion> regions;  // without void
  // Corners of cells in x and y; along z the cells are layers, and borders are drawn in their middles.
  voxel::Lattice corners;
  JobStagesPtr stages;
  size_t memory_bytes = 0;  // as requested

  int64_t layers() const { return corners.count[2]; }
  double middle_mm(int64_t layer) const { return corners.center(0, 0, layer).z; }
  // Returns the height of a face: face 0 is the bottom of layer 0, and so on.
  double face_mm(int64_t face) const { return corners.origin.z + corners.pitch[2].times(static_cast<double>(face)); }
};

// Plans outlines. Returns nothing, and adds diagnostics, when the design is empty, or cannot be cut so, or z lies
// outside of it.
std::optional<ContourPlan> plan_contours(const Loaded& loaded, const ContourRequest& request, Diagnostics& diagnostics);

// The part of a job that is in flight at once.
struct ContourWork {
  int threads = 1;
  double memory_bytes = 0;  // the most that these layers and stages take, once stages are prepared
};
ContourWork size_contour_work(const ContourPlan& plan, int threads);

// Polygons of plan.regions, in their order. The result of layers does not depend on threads.
using LayerRegions = std::vector<std::vector<surface::Polygon>>;

// Draws layers on several threads, and hands them over in order, one at a time. Throws Cancelled.
void draw_contours(const ContourPlan& plan, int threads, const std::function<void(int64_t, const LayerRegions&)>& take,
                   Progress* progress = nullptr, const StopFlag* stop = nullptr);

}  // namespace ombre::compile
