// Values of some channels in a box of cells; uniform channels take no room.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "design/stage.h"

namespace ombre::compile {

class ValueBlock {
 public:
  // Makes a block in which all values are 0.
  ValueBlock(const IndexBox& box, size_t channels);
  explicit ValueBlock(design::StageValues values);
  // Makes a block in which each channel has one value.
  ValueBlock(const IndexBox& box, std::span<const float> values);

  const IndexBox& box() const { return box_; }
  size_t channels() const { return channels_.size(); }
  bool is_uniform() const;
  bool is_uniform(size_t channel) const { return channels_[channel].size() == 1; }
  float first(size_t channel) const { return channels_[channel][0]; }
  std::vector<float> firsts() const;
  // Copies the values of the cells first, first + (1, 0, 0) ..., which all lie in the box.
  void copy_row(size_t channel, const std::array<int64_t, 3>& first, std::span<float> values) const;
  float at(size_t channel, const std::array<int64_t, 3>& cell) const;
  Interval range(size_t channel) const { return ranges_[channel]; }
  Interval range(size_t channel, const IndexBox& cells) const;
  size_t bytes() const;

 private:
  void find_ranges();
  size_t offset(const std::array<int64_t, 3>& cell) const;

  IndexBox box_;
  std::vector<std::vector<float>> channels_;  // one value if the channel is uniform
  std::vector<Interval> ranges_;              // ranges of the channels, if their values are numbers
};
using ValueBlockPtr = std::shared_ptr<const ValueBlock>;

}  // namespace ombre::compile
