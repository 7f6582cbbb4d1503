// Weighted sums of a solid's voxels.
#include <algorithm>

#include "nodes/stages/filter_stage.h"

namespace ombre::nodes {
namespace {

using design::StageValues;

class LinearStage final : public FilterStage {
 public:
  LinearStage(const design::NodePtr& solid, const FilterUse& use, std::string key,
              std::function<LinearFilter(Vec3)> filter)
      : FilterStage(solid, use), key_(std::move(key)), filter_(std::move(filter)), range_(filter_({1, 1, 1}).range()) {}

  std::string name() const override { return "convolve"; }
  Hash content() const override { return hash_with(key_); }

  Reach reach(Vec3 cell_mm) const override {
    const LinearFilter filter = filter_(cell_mm);
    return {filter.below(), filter.above()};
  }

  void compute(const StageValues& read, StageValues& made, Vec3 cell_mm, const StopFlag* stop) const override {
    const LinearFilter filter = filter_(cell_mm);
    const std::vector<float>& inside = read.channel(FilterStage::inside(read));
    std::vector<float>& share = made.channel(made_share(made));
    add(
        filter, stop, read, [&](size_t n) { return inside[n]; }, share);
    for (size_t c = 0; c < fractions(read); ++c) {
      const std::vector<float>& fraction = read.channel(c);
      // If there is only one material, its sums are those of "inside".
      if (fraction == inside)
        made.channel(c) = share;
      else
        add(
            filter, stop, read, [&](size_t n) { return fraction[n]; }, made.channel(c));
    }
    if (use().count_void)
      add(
          filter, stop, read, [&](size_t n) { return 1 - inside[n]; }, made.channel(made_void(read, made)));
    for (size_t a = 0; a < use().attributes.size(); ++a) {
      const std::vector<float>& values = read.channel(attribute(read, a));
      add(
          filter, stop, read, [&](size_t n) { return inside[n] != 0 ? values[n] : 0.0f; },
          made.channel(made_attribute(made, a)));
    }
  }

 protected:
  Interval material_range() const override { return hull(range_, Interval(0)); }
  Interval share_range() const override { return hull(range_, Interval(0)); }

 private:
  template <class ValueAt>
  static void add(const LinearFilter& filter, const StopFlag* stop, const StageValues& read, const ValueAt& value_at,
                  std::vector<float>& made) {
    const IndexBox& box = read.box();
    NumberGrid grid{{box.size(0), box.size(1), box.size(2)}, {}};
    design::check_stop(stop);
    grid.values.resize(static_cast<size_t>(box.voxels()));
    const auto first = static_cast<double>(value_at(0));
    bool is_same = true;
    for (size_t n = 0; n < grid.values.size(); ++n) {
      grid.values[n] = static_cast<double>(value_at(n));
      is_same &= grid.values[n] == first;
    }
    if (is_same) return add_same(filter, first, made);
    design::check_stop(stop);
    const NumberGrid sums = filter.apply(grid, stop);
    for (size_t n = 0; n < made.size(); ++n)
      made[n] = static_cast<float>(static_cast<double>(made[n]) + sums.values[n]);
  }

  // If all values that are read are equal, the sum of one voxel is used for all.
  static void add_same(const LinearFilter& filter, double value, std::vector<float>& made) {
    if (value == 0) return;
    NumberGrid grid;
    size_t voxels = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
      grid.size[axis] = filter.below()[axis] + filter.above()[axis] + 1;
      voxels *= static_cast<size_t>(grid.size[axis]);
    }
    grid.values.assign(voxels, value);
    const double sum = filter.apply(grid).values[0];
    for (float& number : made) number = static_cast<float>(static_cast<double>(number) + sum);
  }

  std::string key_;
  std::function<LinearFilter(Vec3)> filter_;
  Interval range_;
};

}  // namespace

design::StagePtr make_linear_stage(const design::NodePtr& solid, const FilterUse& use, const std::string& key,
                                   std::function<LinearFilter(Vec3 cell_mm)> filter) {
  return std::make_shared<LinearStage>(solid, use, key, std::move(filter));
}

}  // namespace ombre::nodes
