#include "jobs/quick/near_materials.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "voxel/spread_voxel.h"

namespace ombre::compile {
namespace {

constexpr int64_t box_voxels = 8;  // along each axis, without the margin in which the other material is looked for
constexpr double sampled_share = 0.002, least_sample = 50'000;  // voxels; the least takes milliseconds
constexpr double least_boxes = 2, most_boxes = 256;

// A box of voxels, and what lies around it inside the lattice.
class VoxelBox {
 public:
  VoxelBox(const BoxOfVoxels& voxels, const voxel::TileBox& box, const StopFlag* stop) : box_(box) {
    for (const voxel::LayerResult& layer : voxels(box, stop)) {
      const RunLayer& rows = layer.materials();
      for (uint32_t j = 0; j < rows.height(); ++j) {
        const size_t at = materials_.size();
        materials_.resize(at + rows.width());
        rows.row(j).unpack(materials_.data() + at);
      }
    }
  }

  // Returns the material of a voxel of the lattice; void lies outside the box.
  MaterialId at(const std::array<int64_t, 3>& voxel) const {
    for (size_t axis = 0; axis < 3; ++axis)
      if (voxel[axis] < box_.lo[axis] || voxel[axis] >= box_.hi[axis]) return 0;
    const auto size = [&](size_t axis) { return box_.hi[axis] - box_.lo[axis]; };
    const int64_t row = (voxel[2] - box_.lo[2]) * size(1) + voxel[1] - box_.lo[1];
    return materials_[static_cast<size_t>(row * size(0) + voxel[0] - box_.lo[0])];
  }

 private:
  voxel::TileBox box_;
  std::vector<MaterialId> materials_;
};

// The most voxels between the middles of two whose nearest faces are less than the distance apart.
std::array<int64_t, 3> reach_of(double distance_mm, Vec3 voxel_mm) {
  std::array<int64_t, 3> reach{};
  for (size_t axis = 0; axis < 3; ++axis)
    reach[axis] =
        std::max<int64_t>(1, static_cast<int64_t>(std::ceil(distance_mm / voxel_mm[static_cast<int>(axis)] - 1e-6)));
  return reach;
}

bool is_near(const VoxelBox& voxels, const std::array<int64_t, 3>& voxel, MaterialId near,
             const std::array<int64_t, 3>& reach) {
  for (size_t axis = 0; axis < 3; ++axis)
    for (int64_t step = 1; step <= reach[axis]; ++step)
      for (const int64_t sign : {-1, 1}) {
        std::array<int64_t, 3> other = voxel;
        other[axis] += sign * step;
        if (voxels.at(other) == near) return true;
      }
  return false;
}

voxel::TileBox around(const std::array<int64_t, 3>& corner, const std::array<int64_t, 3>& margin,
                      const std::array<int64_t, 3>& count) {
  voxel::TileBox box;
  for (size_t axis = 0; axis < 3; ++axis) {
    box.lo[axis] = std::max<int64_t>(0, corner[axis] - margin[axis]);
    box.hi[axis] = std::min(count[axis], corner[axis] + box_voxels + margin[axis]);
  }
  return box;
}

}  // namespace

NearMaterials find_near_materials(const BoxOfVoxels& voxels, const voxel::Lattice& lattice, const ApartRule& rule,
                                  const StopFlag* stop) {
  const std::array<int64_t, 3> reach = reach_of(rule.within_mm, lattice.voxel_mm());
  double voxels_of_box = 1;
  for (const int64_t margin : reach) voxels_of_box *= static_cast<double>(box_voxels + 2 * margin);
  const double sample = std::max(least_sample, sampled_share * static_cast<double>(lattice.voxels()));
  const double boxes = std::clamp(sample / voxels_of_box, least_boxes, most_boxes);
  NearMaterials found;
  for (uint64_t n = 0; n < static_cast<uint64_t>(boxes); ++n) {
    const std::array<int64_t, 3> corner = voxel::spread_voxel(n, lattice.count);
    const VoxelBox sample(voxels, around(corner, reach, lattice.count), stop);
    const voxel::TileBox core = around(corner, {}, lattice.count);
    for (int64_t k = core.lo[2]; k < core.hi[2]; ++k)
      for (int64_t j = core.lo[1]; j < core.hi[1]; ++j)
        for (int64_t i = core.lo[0]; i < core.hi[0]; ++i) {
          if (sample.at({i, j, k}) != rule.material) continue;
          ++found.voxels;
          if (!is_near(sample, {i, j, k}, rule.near, reach)) continue;
          if (found.found++ == 0) found.first_mm = lattice.center(i, j, k);
        }
  }
  return found;
}

}  // namespace ombre::compile
