#include "stages/value_block.h"

#include <algorithm>

namespace ombre::compile {

ValueBlock::ValueBlock(const IndexBox& box, size_t channels) : box_(box), channels_(channels, {0.0f}) { find_ranges(); }

ValueBlock::ValueBlock(design::StageValues values) : box_(values.box()) {
  for (size_t n = 0; n < values.channels(); ++n) {
    std::vector<float>& channel = values.channel(n);
    const bool is_same = std::all_of(channel.begin(), channel.end(), [&](float v) { return v == channel[0]; });
    channels_.push_back(is_same ? std::vector<float>{channel[0]} : std::move(channel));
  }
  find_ranges();
}

ValueBlock::ValueBlock(const IndexBox& box, std::span<const float> values) : box_(box) {
  for (const float value : values) channels_.push_back({value});
  find_ranges();
}

void ValueBlock::find_ranges() {
  for (const auto& channel : channels_) {
    float least = channel[0], greatest = channel[0];
    for (const float v : channel) {
      least = v < least ? v : least;
      greatest = v > greatest ? v : greatest;
    }
    ranges_.emplace_back(least, greatest);
  }
}

bool ValueBlock::is_uniform() const {
  return std::all_of(channels_.begin(), channels_.end(), [](const auto& channel) { return channel.size() == 1; });
}

std::vector<float> ValueBlock::firsts() const {
  std::vector<float> values;
  for (const auto& channel : channels_) values.push_back(channel[0]);
  return values;
}

void ValueBlock::copy_row(size_t channel, const std::array<int64_t, 3>& first, std::span<float> values) const {
  const std::vector<float>& from = channels_[channel];
  if (from.size() == 1)
    std::fill(values.begin(), values.end(), from[0]);
  else
    std::copy_n(from.begin() + static_cast<ptrdiff_t>(offset(first)), values.size(), values.begin());
}

float ValueBlock::at(size_t channel, const std::array<int64_t, 3>& cell) const {
  const std::vector<float>& from = channels_[channel];
  return from.size() == 1 ? from[0] : from[offset(cell)];
}

Interval ValueBlock::range(size_t channel, const IndexBox& cells) const {
  if (is_uniform(channel)) return Interval(first(channel));
  const IndexBox box = intersect(cells, box_);
  const std::vector<float>& from = channels_[channel];
  float lo = at(channel, box.lo), hi = lo;
  for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
    for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
      const auto row = from.begin() + static_cast<ptrdiff_t>(offset({box.lo[0], j, k}));
      const auto [least, greatest] = std::minmax_element(row, row + box.size(0));
      lo = std::min(lo, *least);
      hi = std::max(hi, *greatest);
    }
  return {lo, hi};
}

size_t ValueBlock::bytes() const {
  constexpr size_t own = 256;  // size of the object with its place in a table, bytes
  size_t bytes = own;
  for (const auto& channel : channels_) bytes += sizeof(std::vector<float>) + channel.capacity() * sizeof(float);
  return bytes;
}

size_t ValueBlock::offset(const std::array<int64_t, 3>& cell) const {
  return static_cast<size_t>(((cell[2] - box_.lo[2]) * box_.size(1) + (cell[1] - box_.lo[1])) * box_.size(0) +
                             (cell[0] - box_.lo[0]));
}

}  // namespace ombre::compile
