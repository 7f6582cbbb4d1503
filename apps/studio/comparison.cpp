// Compares two designs: the volumes that one has gained, lost and changed against the other.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "studio/sampled_design.h"
#include "studio/views.h"

namespace ombre::studio {
namespace {

using voxel::TileBox;

// Samples two designs on one lattice.
class Pair {
 public:
  Pair(const OpenDesign& before, const OpenDesign& after, const StopFlag& stop)
      : box_(hull(before.bounds, after.bounds)),
        sides_{sample(before, box_, measured_voxels, stop), sample(after, box_, measured_voxels, stop)} {
    for (const SampledDesign& side : sides_) side.job.stages->prepare({});
  }
  // Lists the materials of both by name, since another file of materials numbers them otherwise.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const SampledDesign& side : sides_)
      for (const compile::Grid& grid : side.job.grids)
        if (std::ranges::find(names, grid.name) == names.end()) names.push_back(grid.name);
    return names;
  }
  const SampledDesign& side(size_t n) const { return sides_[n]; }
  std::vector<TileBox> slabs() const {
    constexpr int64_t layers = 8;
    std::vector<TileBox> slabs;
    const auto& count = sides_[0].plan.request.lattice.count;
    for (int64_t k = 0; k < count[2]; k += layers)
      slabs.push_back({{0, 0, k}, {count[0], count[1], std::min(k + layers, count[2])}});
    return slabs;
  }
  double voxel_mm3() const { return sides_[0].pitch_mm() * sides_[0].pitch_mm() * sides_[0].pitch_mm(); }

 private:
  Box box_;
  std::array<SampledDesign, 2> sides_;
};

// Returns the fractions of each material in each voxel of the slab, material after material.
std::vector<float> fractions(const SampledDesign& design, const std::vector<std::string>& names, const TileBox& slab,
                             const StopFlag& stop) {
  const auto voxels = static_cast<size_t>(slab.voxels());
  std::vector<float> dense(names.size() * voxels, 0);
  if (design.job.grids.empty()) return dense;
  for (const voxel::FieldTile& tile : design.job.tiles(slab, &stop))
    for (size_t grid = 0; grid < design.job.grids.size(); ++grid) {
      const auto name = std::ranges::find(names, design.job.grids[grid].name) - names.begin();
      const float* from = tile.output(grid);
      for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
        for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j) {
          const int64_t row = ((k - slab.lo[2]) * slab.size(1) + j - slab.lo[1]) * slab.size(0);
          float* to = dense.data() + static_cast<size_t>(name) * voxels + row + (tile.box.lo[0] - slab.lo[0]);
          for (int64_t i = 0; i < tile.box.size(0); ++i, from += tile.is_uniform ? 0 : 1)
            *to++ = *from > 0 ? *from : 0;  // NaN becomes 0
        }
    }
  return dense;
}

// Sums over voxels of the shares that were gained, lost and so on.
struct Sums {
  explicit Sums(size_t materials) : before(materials, 0), after(materials, 0) {}
  void add(const Sums& other) {
    gained += other.gained;
    lost += other.lost;
    changed += other.changed;
    unchanged += other.unchanged;
    for (size_t m = 0; m < before.size(); ++m) {
      before[m] += other.before[m];
      after[m] += other.after[m];
    }
  }

  double gained = 0, lost = 0, changed = 0, unchanged = 0;
  std::vector<double> before, after;  // volume of each material
};

// Compares the designs in a slab. In each voxel the lesser share of a material is unchanged; the rest of what both
// designs fill has changed.
Sums compare_slab(const Pair& pair, const std::vector<std::string>& names, const TileBox& slab, const StopFlag& stop) {
  const std::vector<float> before = fractions(pair.side(0), names, slab, stop);
  const std::vector<float> after = fractions(pair.side(1), names, slab, stop);
  Sums sums(names.size());
  const auto voxels = static_cast<size_t>(slab.voxels());
  for (size_t v = 0; v < voxels; ++v) {
    double old_filled = 0, new_filled = 0, same = 0;
    for (size_t m = 0; m < names.size(); ++m) {
      const auto was = static_cast<double>(before[m * voxels + v]), is = static_cast<double>(after[m * voxels + v]);
      old_filled += was;
      new_filled += is;
      same += std::min(was, is);
      sums.before[m] += was;
      sums.after[m] += is;
    }
    sums.gained += std::max(0.0, new_filled - old_filled);
    sums.lost += std::max(0.0, old_filled - new_filled);
    sums.changed += std::min(old_filled, new_filled) - same;
    sums.unchanged += same;
  }
  return sums;
}

}  // namespace

Answer compare_answer(const OpenDesign& before, const OpenDesign& after, const StopFlag& stop) {
  const Pair pair(before, after, stop);
  const std::vector<std::string> names = pair.names();
  const std::vector<TileBox> slabs = pair.slabs();
  Sums sums(names.size());
  run_ordered<Sums>(
      slabs.size(), 0, size_t{2} * static_cast<size_t>(core_count()),
      [&](size_t n) {
        if (stop.requested()) throw Cancelled();
        return compare_slab(pair, names, slabs[n], stop);
      },
      [&](size_t, Sums& slab) { sums.add(slab); });
  const double voxel = pair.voxel_mm3();
  DataList materials;
  for (size_t m = 0; m < names.size(); ++m)
    materials.emplace_back(
        DataMembers{{"name", names[m]}, {"before_mm3", voxel * sums.before[m]}, {"after_mm3", voxel * sums.after[m]}});
  return {{{"gained_mm3", voxel * sums.gained},
           {"lost_mm3", voxel * sums.lost},
           {"changed_mm3", voxel * sums.changed},
           {"unchanged_mm3", voxel * sums.unchanged},
           {"pitch_mm", pair.side(0).pitch_mm()},
           {"materials", std::move(materials)}},
          {}};
}

}  // namespace ombre::studio
