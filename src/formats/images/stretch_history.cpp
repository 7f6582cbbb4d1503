#include "formats/images/stretch_history.h"

#include <algorithm>
#include <cstring>

#include "formats/containers/deflate_symbols.h"

namespace ombre::formats {
namespace {

constexpr uint32_t stretch_window = DeflateWriter::window;
constexpr uint32_t first_stretch = 2 * stretch_window;  // beyond the window from position 0
constexpr uint32_t last_stretch = uint32_t{1} << 31;    // far below overflow
constexpr unsigned stretch_bits = 10;

size_t slot(Rgba pixel, uint32_t count) {
  uint32_t word;
  std::memcpy(&word, pixel.data(), sizeof word);
  return (word ^ uint64_t{count} << 32) * 0x9E3779B97F4A7C15 >> (64 - stretch_bits);
}

}  // namespace

StretchHistory::StretchHistory() : latest_(size_t{1} << stretch_bits) { clear(); }

void StretchHistory::clear() {
  if (position_ == first_stretch) return;
  position_ = first_stretch;
  std::fill(latest_.begin(), latest_.end(), Stretch());
  last_ = nullptr;
  more_zeros_ = 0;
}

void StretchHistory::put_filter(uint8_t filter, DeflateWriter& out) {
  if (position_ > last_stretch) clear();
  out.literals(&filter, 1);
  ++position_;
  last_ = nullptr;
  more_zeros_ = 0;
}

void StretchHistory::put(Rgba pixel, uint32_t count, DeflateWriter& out) {
  if (pixel == Rgba{})
    put_zeros(count, out);
  else
    put_edge(pixel, count, out);
  position_ += 4 * count;
}

void StretchHistory::put_zeros(uint32_t count, DeflateWriter& out) {
  const uint32_t size = 4 * count;
  uint32_t written = std::min(size, more_zeros_);
  if (written + DeflateWriter::shortest_match > size && written < size) written = size - DeflateWriter::shortest_match;
  if (written < DeflateWriter::shortest_match) {
    constexpr uint8_t zero = 0;
    out.literals(&zero, written = 1);
  } else {
    out.match(written, distance_);
  }
  if (written < size) out.match(size - written, 1);
  if (last_) last_->zeros = count;
  last_ = nullptr;
  more_zeros_ = 0;
}

void StretchHistory::put_edge(Rgba pixel, uint32_t count, DeflateWriter& out) {
  Stretch& latest = latest_[slot(pixel, count)];
  const uint32_t size = 4 * count, distance = position_ - latest.position;
  more_zeros_ = 0;
  if (size <= longest_match && distance <= stretch_window && latest.pixel == pixel && latest.count == count) {
    out.match(size, distance);
    more_zeros_ = std::min(longest_match - size, 4 * latest.zeros);
    distance_ = distance;
  } else {
    const bool is_one_byte = pixel == Rgba{pixel[0], pixel[0], pixel[0], pixel[0]};
    const uint32_t period = is_one_byte ? 1 : 4;
    out.literals(pixel.data(), period);
    if (size > period) out.match(size - period, period);
  }
  latest = {position_, pixel, count, 0};
  last_ = &latest;
}

}  // namespace ombre::formats
