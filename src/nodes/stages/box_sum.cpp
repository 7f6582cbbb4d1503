#include "nodes/stages/box_sum.h"

#include <algorithm>

#include "base/text/text.h"
#include "design/design.h"

namespace ombre::nodes {
namespace {

using design::StageChannel;
using design::StageValues;

// Fractions are added as integers, so that sums do not depend on the order.
constexpr double fixed_point = 0x1p-24;

// Numbers in a box, with x varying fastest.
struct NumberBlock {
  std::array<int64_t, 3> size{};
  std::vector<int64_t> values;
};

// Returns sums of `length` neighbours along an axis, by one addition and one subtraction each.
NumberBlock sums_along(const NumberBlock& block, size_t axis, int64_t length, const StopFlag* stop) {
  NumberBlock made{block.size, {}};
  made.size[axis] -= length - 1;
  made.values.resize(static_cast<size_t>(made.size[0] * made.size[1] * made.size[2]));
  // Adjacent lines of numbers are added together.
  int64_t side = 1;
  for (size_t a = 0; a < axis; ++a) side *= block.size[a];
  const int64_t lines = static_cast<int64_t>(block.values.size()) / (side * block.size[axis]);
  std::vector<int64_t> sum(static_cast<size_t>(side));
  for (int64_t line = 0; line < lines; ++line) {
    design::check_stop(stop);
    const int64_t* const from = block.values.data() + line * side * block.size[axis];
    int64_t* const to = made.values.data() + line * side * made.size[axis];
    std::ranges::fill(sum, 0);
    for (int64_t n = 0; n < block.size[axis]; ++n) {
      if (side > 1) design::check_stop(stop);
      for (int64_t s = 0; s < side; ++s) sum[static_cast<size_t>(s)] += from[n * side + s];
      const int64_t first = n - length + 1;
      if (first < 0) continue;
      std::ranges::copy(sum, to + first * side);
      for (int64_t s = 0; s < side; ++s) sum[static_cast<size_t>(s)] -= from[first * side + s];
    }
  }
  return made;
}

class BoxSumStage final : public design::HaloStage {
 public:
  BoxSumStage(const design::NodePtr& solid, const BoxSums& use) : solid_(solid), use_(use) {}

  std::string name() const override { return "blend"; }
  Hash content() const override {
    std::string text = "box sums";
    for (const int n : use_.size) text += ' ' + std::to_string(n);
    return hash_bytes(text + (use_.count_void ? " with void" : ""));
  }
  Box bounds() const override { return solid_->bounds(design::design_space()); }
  design::LatticeChoice lattice() const override { return {use_.cell_mm, false}; }

  std::vector<design::StageRead> reads() const override {
    return {{.solid = solid_, .inside = true, .fractions = true}};
  }

  std::vector<StageChannel> channels(const std::vector<StageChannel>& read) const override {
    std::vector<StageChannel> made;
    for (const StageChannel& channel : read)
      if (channel.material) made.push_back(sums_of(*channel.material));
    const auto is_void = [](const StageChannel& channel) { return channel.material == void_material; };
    if (use_.count_void && std::ranges::none_of(made, is_void)) made.push_back(sums_of(void_material));
    return made;
  }

  Reach reach(Vec3) const override {
    Reach reach;
    for (size_t axis = 0; axis < 3; ++axis) {
      reach.below[axis] = use_.size[axis] / 2;
      reach.above[axis] = use_.size[axis] - 1 - use_.size[axis] / 2;
    }
    return reach;
  }

  // The channels read are the fractions and then "inside". Void comes first if the solid itself contains it.
  void compute(const StageValues& read, StageValues& made, Vec3, const StopFlag* stop) const override {
    const size_t fractions = read.channels() - 1;
    for (size_t c = 0; c < fractions; ++c) add(read, c, false, made, c, stop);
    if (!use_.count_void) return;
    const bool has_own_void = made.channels() == fractions;
    add(read, fractions, true, made, has_own_void ? 0 : fractions, stop);
  }

 private:
  StageChannel sums_of(MaterialId material) const {
    const double voxels = static_cast<double>(use_.size[0]) * use_.size[1] * use_.size[2];
    return {sum_channel(material), material, 0, false, {0, voxels}};
  }

  // Adds the sums of a channel, or of 1 minus the channel.
  void add(const StageValues& read, size_t from, bool is_rest, StageValues& made, size_t to,
           const StopFlag* stop) const {
    const std::vector<float>& values = read.channel(from);
    const float none = is_rest ? 1 : 0;
    if (std::ranges::all_of(values, [&](float v) { return v == none; })) return;
    NumberBlock block{{read.box().size(0), read.box().size(1), read.box().size(2)}, {}};
    block.values.reserve(values.size());
    // Rounds to the nearest integer; values are never negative.
    const double scale = is_rest ? -1 / fixed_point : 1 / fixed_point, offset = (is_rest ? 1 / fixed_point : 0) + 0.5;
    for (const float v : values) block.values.push_back(static_cast<int64_t>(scale * static_cast<double>(v) + offset));
    for (size_t axis = 0; axis < 3; ++axis)
      if (use_.size[axis] > 1) block = sums_along(block, axis, use_.size[axis], stop);
    std::vector<float>& sums = made.channel(to);
    for (size_t n = 0; n < sums.size(); ++n)
      sums[n] += static_cast<float>(static_cast<double>(block.values[n]) * fixed_point);
  }

  design::NodePtr solid_;
  BoxSums use_;
};

}  // namespace

design::StagePtr make_box_sums(const design::NodePtr& solid, const BoxSums& use) {
  return std::make_shared<BoxSumStage>(solid, use);
}

std::string sum_channel(MaterialId material) { return "material " + std::to_string(material); }

}  // namespace ombre::nodes
