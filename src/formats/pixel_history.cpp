#include "formats/pixel_history.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "formats/deflate.h"

namespace ombre::formats {
namespace {

uint64_t word_at(const MaterialId* voxels) {
  uint64_t word;
  std::memcpy(&word, voxels, sizeof word);
  return word;
}

// How many pixels from `a` and `b` on agree. Whole words may be read behind the last.
uint32_t common_length(const MaterialId* a, const MaterialId* b, uint32_t most) {
  static_assert(std::endian::native == std::endian::little);
  for (uint32_t i = 0; i < most; i += 8)
    if (const uint64_t differences = word_at(a + i) ^ word_at(b + i))
      return std::min(most, i + static_cast<uint32_t>(std::countr_zero(differences)) / 8);
  return most;
}

}  // namespace

PixelHistory::PixelHistory(uint32_t width)
    : width_(width),
      kept_rows_(DeflateWriter::window / 4 / width + 1),
      pixels_(size_t{2} * (kept_rows_ + 1) * width + 8),
      positions_(size_t{1} << table_bits) {}

void PixelHistory::clear() { oldest_ = end_; }

void PixelHistory::add_row(const MaterialId* voxels) {
  if (end_ + width_ > first_ + 2 * (kept_rows_ + 1) * width_) {
    const uint32_t kept = kept_rows_ * width_;
    std::memmove(pixels_.data(), at(end_ - kept), kept);
    first_ = end_ - kept;
    // Rows apart, as before.
    while (oldest_ < first_) oldest_ += width_;
  }
  row_ = end_;
  end_ += width_;
  std::memcpy(pixels_.data() + (row_ - first_), voxels, width_);
}

PixelHistory::Match PixelHistory::find(uint32_t column) const {
  if (column + key_pixels > width_) return {};
  const uint32_t here = row_ + column, there = positions_[slot(here)];
  if (there < oldest_) return {};
  const uint32_t rows = there >= row_ ? 0 : (row_ - there + width_ - 1) / width_;
  const uint32_t distance = 4 * (here - there) + rows;
  if (distance > DeflateWriter::window) return {};
  const uint32_t left_here = width_ - column, left_there = end_ - rows * width_ - there;
  return {common_length(at(there), at(here), std::min(left_here, left_there)), distance};
}

void PixelHistory::learn(uint32_t begin, uint32_t end) {
  const uint32_t last = std::min(end, width_ - std::min(width_, key_pixels - 1));
  for (uint32_t column = begin; column < last; ++column) positions_[slot(row_ + column)] = row_ + column;
}

size_t PixelHistory::slot(uint32_t position) const {
  return word_at(at(position)) * 0x9E3779B97F4A7C15 >> (64 - table_bits);
}

}  // namespace ombre::formats
