// Filters that select one of the values in a box of voxels.
#include <algorithm>

#include "nodes/stages/filter_stage.h"

namespace ombre::nodes {
namespace {

using design::StageValues;
using Cell = std::array<int64_t, 3>;

class BoxStage : public FilterStage {
 public:
  BoxStage(const design::NodePtr& solid, const FilterUse& use, const design::Counts3& size)
      : FilterStage(solid, use), size_(size) {}

  Reach reach(Vec3) const override {
    Reach reach;
    for (size_t axis = 0; axis < 3; ++axis) {
      reach.below[axis] = size_[axis] / 2;
      reach.above[axis] = size_[axis] - 1 - size_[axis] / 2;
    }
    return reach;
  }

 protected:
  std::string size_text() const {
    return std::to_string(size_[0]) + ' ' + std::to_string(size_[1]) + ' ' + std::to_string(size_[2]);
  }

  template <class Visit>
  static void each_cell(const IndexBox& box, const StopFlag* stop, const Visit& visit) {
    size_t n = 0;
    for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (int64_t j = box.lo[1]; j < box.hi[1]; ++j)
        for (int64_t i = box.lo[0]; i < box.hi[0]; ++i, ++n) {
          design::check_stop(stop);
          visit(Cell{i, j, k}, n);
        }
  }

  // Visits the positions in `read` of the voxels in the box around a cell.
  template <class Visit>
  void each_near(const StageValues& read, const Cell& cell, const Visit& visit) const {
    const Reach reach = this->reach({});
    for (int64_t z = cell[2] - reach.below[2]; z <= cell[2] + reach.above[2]; ++z)
      for (int64_t y = cell[1] - reach.below[1]; y <= cell[1] + reach.above[1]; ++y) {
        const size_t first = read.offset(cell[0] - reach.below[0], y, z);
        for (size_t x = 0; x < static_cast<size_t>(size_[0]); ++x) visit(first + x);
      }
  }

 private:
  design::Counts3 size_;
};

class MajorityStage final : public BoxStage {
 public:
  using BoxStage::BoxStage;
  std::string name() const override { return "majority"; }
  Hash content() const override { return hash_with("majority " + size_text()); }

  void compute(const StageValues& read, StageValues& made, Vec3, const StopFlag* stop) const override {
    const size_t count = fractions(read) + (use().count_void ? 1 : 0);
    const std::vector<float>& inside = read.channel(FilterStage::inside(read));
    // Sums are computed in double precision and always in the same order.
    std::vector<double> sums(count);
    each_cell(made.box(), stop, [&](const Cell& cell, size_t n) {
      std::ranges::fill(sums, 0.0);
      each_near(read, cell, [&](size_t at) {
        for (size_t c = 0; c < fractions(read); ++c) sums[c] += static_cast<double>(read.channel(c)[at]);
        if (use().count_void) sums[count - 1] += 1 - static_cast<double>(inside[at]);
      });
      const size_t own = own_material(read, read.offset(cell[0], cell[1], cell[2]));
      const size_t winner = own < count && is_greatest(sums, own) ? own : greatest(sums);
      if (!(sums[winner] > 0)) return;
      const bool is_added_void = use().count_void && winner == count - 1;
      made.channel(is_added_void ? made_void(read, made) : winner)[n] = 1;
      made.channel(made_share(made))[n] = 1;
    });
  }

 private:
  static size_t greatest(const std::vector<double>& sums) {
    return static_cast<size_t>(std::ranges::max_element(sums) - sums.begin());
  }
  static bool is_greatest(const std::vector<double>& sums, size_t n) { return sums[n] == sums[greatest(sums)]; }
  size_t own_material(const StageValues& read, size_t at) const {
    size_t own = fractions(read);
    for (size_t c = 0; c < fractions(read); ++c)
      if (read.channel(c)[at] > (own < fractions(read) ? read.channel(own)[at] : 0.0f)) own = c;
    return own;
  }
};

class MedianStage final : public BoxStage {
 public:
  using BoxStage::BoxStage;
  std::string name() const override { return "median"; }
  Hash content() const override { return hash_with("median " + size_text()); }

  void compute(const StageValues& read, StageValues& made, Vec3, const StopFlag* stop) const override {
    const std::vector<float>& inside = read.channel(FilterStage::inside(read));
    std::vector<float> values;
    for (size_t a = 0; a < use().attributes.size(); ++a)
      each_cell(made.box(), stop, [&](const Cell& cell, size_t n) {
        values.clear();
        each_near(read, cell, [&](size_t at) {
          if (inside[at] != 0) values.push_back(read.channel(attribute(read, a))[at]);
        });
        if (values.empty()) return;
        const auto middle = values.begin() + static_cast<ptrdiff_t>((values.size() - 1) / 2);
        std::nth_element(values.begin(), middle, values.end());
        made.channel(made_attribute(made, a))[n] = *middle;
        made.channel(made_share(made))[n] = 1;
      });
  }
};

}  // namespace

design::StagePtr make_majority_stage(const design::NodePtr& solid, const FilterUse& use, const design::Counts3& size) {
  return std::make_shared<MajorityStage>(solid, use, size);
}

design::StagePtr make_median_stage(const design::NodePtr& solid, const FilterUse& use, const design::Counts3& size) {
  return std::make_shared<MedianStage>(solid, use, size);
}

}  // namespace ombre::nodes
