#include "jobs/slice/plan_part.h"

#include "base/text/text.h"
#include "jobs/slice/layer.h"
#include "options/option_values.h"

namespace ombre::compile {
namespace {

std::string corner_text(Vec3 p) {
  return format_rounded(p.x, 6) + "," + format_rounded(p.y, 6) + "," + format_rounded(p.z, 6);
}

voxel::TileBox moved(voxel::TileBox box, const std::array<int64_t, 3>& by) {
  for (size_t axis = 0; axis < 3; ++axis) {
    box.lo[axis] += by[axis];
    box.hi[axis] += by[axis];
  }
  return box;
}

// Returns a producer of voxels that are counted from `first`.
RegionProducer counted_from(const std::array<int64_t, 3>& first, RegionProducer whole) {
  return [first, whole = std::move(whole)](const voxel::TileBox& box, const StopFlag* stop) {
    std::vector<voxel::LayerResult> layers = whole(moved(box, first), stop);
    for (voxel::LayerResult& layer : layers)
      for (voxel::CheckHits& check : layer.checks)
        for (size_t axis = 0; axis < 3; ++axis) check.first[axis] -= first[axis];
    return layers;
  };
}

}  // namespace

std::optional<voxel::TileBox> region_over(const voxel::Lattice& lattice, const Box& box) {
  voxel::TileBox region;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto voxels = voxels_over(lattice, axis, box.axis(static_cast<int>(axis)));
    if (!voxels) return std::nullopt;
    region.lo[axis] = voxels->first;
    region.hi[axis] = voxels->second;
  }
  return region;
}

voxel::TileBox chosen_region(const std::optional<Box>& box, const voxel::Lattice& lattice) {
  if (!box) return {{0, 0, 0}, lattice.count};
  if (const auto region = region_over(lattice, *box)) return *region;
  const Box part = lattice.box();
  throw options::WrongValue(spelled::option("--box", corner_text(box->lo) + "," + corner_text(box->hi)) +
                            " is beside the part, which lies from " + corner_text(part.lo) + " to " +
                            corner_text(part.hi) + " mm");
}

Plan part_of(Plan plan, const voxel::TileBox& region) {
  const std::array<int64_t, 3> whole = plan.request.lattice.count;
  if (region == voxel::TileBox{{0, 0, 0}, whole}) return plan;
  plan.request.part = PartOfJob{region.lo, whole};
  plan.request.lattice = voxel::part_of(plan.request.lattice, region);
  plan.request.first_index += region.lo[2];
  plan.regions = counted_from(region.lo, std::move(plan.regions));
  plan.samples = counted_from(region.lo, std::move(plan.samples));
  plan.producer = whole_layers(plan.regions, plan.request.lattice);
  return plan;
}

}  // namespace ombre::compile
