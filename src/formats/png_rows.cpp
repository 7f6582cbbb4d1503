// Rows of runs to the bytes of PNG rows.
#include "formats/png_rows.h"

#include <algorithm>
#include <cstring>

#include "base/assert.h"

namespace ombre::formats {
namespace {

uint64_t bits_per_pixel(const Palette& palette, const PngLayout& layout) {
  return layout.format == PngFormat::rgba ? 32 : static_cast<uint64_t>(palette.bit_depth());
}

// `entry` in every pixel of a byte.
uint8_t repeated(uint8_t entry, int bit_depth) {
  unsigned byte = entry;
  for (int filled = bit_depth; filled < 8; filled *= 2) byte |= byte << filled;
  return static_cast<uint8_t>(byte);
}

void merge(uint8_t& byte, unsigned value, unsigned mask) {
  byte = static_cast<uint8_t>((byte & ~mask) | (value & mask));
}

}  // namespace

RowPacker::RowPacker(uint32_t width, const Palette& palette, const PngLayout& layout)
    : width_(width),
      palette_(palette),
      layout_(layout),
      bit_depth_(palette.bit_depth()),
      bytes_((width * bits_per_pixel(palette, layout) + 7) / 8) {}

const std::vector<uint8_t>& RowPacker::pack(const RowView& row) {
  if (layout_.format == PngFormat::indexed) bytes_.back() = 0;  // the spare bits of the last byte
  uint64_t filled = 0;
  const auto put = [&](const Run& run) {
    const uint64_t begin = layout_.flip_x ? width_ - filled - run.length : filled;
    layout_.format == PngFormat::rgba ? put_rgba(begin, run) : put_indexed(begin, run);
    filled += run.length;
  };
  const MaterialId* loose = row.dense.data();
  for (const Run& run : row.runs) {
    if (!run.is_dense) put(run);
    for (uint32_t i = 0; run.is_dense && i < run.length; ++i) put({*loose++, false, 1});
  }
  return bytes_;
}

void RowPacker::put_rgba(uint64_t begin, const Run& run) {
  const Rgba colour = palette_.colours()[palette_.entry(run.material)];
  ASSERT((begin + run.length) * 4 <= bytes_.size());
  uint8_t* out = bytes_.data() + begin * 4;
  for (uint32_t i = 0; i < run.length; ++i) std::memcpy(out + size_t{4} * i, colour.data(), 4);
}

void RowPacker::put_indexed(uint64_t begin, const Run& run) {
  const uint8_t value = repeated(palette_.entry(run.material), bit_depth_);
  const uint64_t first_bit = begin * static_cast<uint64_t>(bit_depth_);
  const uint64_t last_bit = (begin + run.length) * static_cast<uint64_t>(bit_depth_);
  ASSERT(last_bit <= bytes_.size() * 8);

  // Pixels fill a byte from its high bits down.
  const size_t first = first_bit / 8, last = last_bit / 8;
  const unsigned from_first = 0xFFU >> (first_bit % 8), before_last = 0xFF00U >> (last_bit % 8) & 0xFFU;
  if (first == last) {
    if (from_first & before_last) merge(bytes_[first], value, from_first & before_last);
    return;
  }
  merge(bytes_[first], value, from_first);
  std::fill(bytes_.begin() + static_cast<std::ptrdiff_t>(first) + 1, bytes_.begin() + static_cast<std::ptrdiff_t>(last),
            value);
  if (before_last) merge(bytes_[last], value, before_last);
}

}  // namespace ombre::formats
