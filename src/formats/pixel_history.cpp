#include "formats/pixel_history.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "formats/deflate.h"

namespace ombre::formats {
namespace {

constexpr uint32_t short_key_pixels = 4;
constexpr uint32_t last_position = uint32_t{1} << 31;  // far enough from overflow

uint64_t word_at(const MaterialId* voxels) {
  uint64_t word;
  std::memcpy(&word, voxels, sizeof word);
  return word;
}

// In a word of memory.
constexpr uint64_t first_bytes(uint32_t count) { return ~uint64_t{0} >> (64 - 8 * count); }

// Where the table entry of the pixels under `mask` stands; others may share it.
size_t slot(const MaterialId* pixels, uint64_t mask, unsigned shift) {
  return (word_at(pixels) & mask) * 0x9E3779B97F4A7C15 >> shift;
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
      long_keys_(13),
      short_keys_(10),
      before_(width) {}

void PixelHistory::clear() { oldest_ = end_; }

void PixelHistory::restart() {
  first_ = oldest_ = row_ = end_ = 1;
  std::fill(long_keys_.positions.begin(), long_keys_.positions.end(), 0);
  std::fill(short_keys_.positions.begin(), short_keys_.positions.end(), 0);
}

void PixelHistory::add_row(const MaterialId* voxels) {
  if (end_ > last_position) restart();
  if (end_ + width_ > first_ + 2 * (kept_rows_ + 1) * width_) {
    const uint32_t kept = kept_rows_ * width_;
    std::memmove(pixels_.data(), at(end_ - kept), kept);
    first_ = end_ - kept;
    while (oldest_ < first_) oldest_ += width_;
  }
  row_ = end_;
  end_ += width_;
  MaterialId* const pixels = pixels_.data() + (row_ - first_);
  std::memcpy(pixels, voxels, width_);

  const uint32_t count = width_ - std::min(width_, key_pixels_ - 1);
  long_keys_.exchange(pixels, count, row_, first_bytes(key_pixels_), before_.data());
  std::fill(before_.begin() + count, before_.end(), 0);
}

PixelHistory::Match PixelHistory::find(uint32_t column) {
  uint32_t there = 0;
  short_keys_.exchange(at(row_ + column), 1, row_ + column, first_bytes(short_key_pixels), &there);
  const Match best = match(column, before_[column]);
  return best.pixels >= short_key_pixels ? best : match(column, there);
}

PixelHistory::Match PixelHistory::match(uint32_t column, uint32_t there) const {
  if (there < oldest_) return {};
  const uint32_t here = row_ + column;
  const uint32_t rows = there >= row_ ? 0 : (row_ - there + width_ - 1) / width_;
  const uint32_t distance = 4 * (here - there) + rows;
  if (distance > DeflateWriter::window) return {};
  const uint32_t left_here = width_ - column, left_there = end_ - rows * width_ - there;
  return {common_length(at(there), at(here), std::min(left_here, left_there)), distance};
}

void PixelHistory::Table::exchange(const MaterialId* pixels, uint32_t count, uint32_t position, uint64_t mask,
                                   uint32_t* before) {
  uint32_t* const table = positions.data();  // which no store below can move
  const unsigned by = shift;
  for (uint32_t i = 0; i < count; ++i) {
    uint32_t& latest = table[slot(pixels + i, mask, by)];
    before[i] = latest;
    latest = position + i;
  }
}

}  // namespace ombre::formats
