#include "formats/pixel_history.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace ombre::formats {
namespace {

constexpr uint32_t window = DeflateWriter::window;
constexpr uint32_t first_position = 2 * window;        // out of reach from there: position 0
constexpr uint32_t last_position = uint32_t{1} << 31;  // far enough from overflow
constexpr size_t word_bytes = sizeof(uint64_t);
constexpr unsigned sure_bits = 56;  // of a word, wherever it begins

// How many pixels a match is found by. The window holds 8192, so stretches of 12 bits mostly stand in it.
// Pixels of many bits seldom use them all.
template <unsigned bits>
struct Keys {
  static constexpr uint32_t pixels = (bits <= 2 ? 12 : 24) / bits, short_pixels = pixels / 2;
};

constexpr unsigned more_bits = 8;  // a match that goes on for so long is followed to its end

constexpr unsigned table_bits = 12, short_table_bits = 8;

// The slot of the pixels in the high bits of a word; others may share it.
template <unsigned key_bits, unsigned slot_bits>
size_t slot(uint64_t word) {
  const uint64_t key = word >> (64 - key_bits);
  if constexpr (key_bits <= slot_bits) return key;
  return key * 0x9E3779B97F4A7C15 >> (64 - slot_bits);
}

// The first byte is the highest.
uint64_t load(const uint8_t* bytes) {
  static_assert(std::endian::native == std::endian::little);
  uint64_t word;
  std::memcpy(&word, bytes, sizeof word);
  return __builtin_bswap64(word);
}

void store_word(uint8_t* bytes, uint64_t word) {
  word = __builtin_bswap64(word);
  std::memcpy(bytes, &word, sizeof word);
}

uint64_t word_at(const uint8_t* bytes, size_t bit) { return load(bytes + bit / 8) << bit % 8; }

// In how many columns a stretch of pixels can begin.
uint32_t begin_count(uint32_t width, uint32_t pixels) { return width - std::min(width, pixels - 1); }

}  // namespace

PixelHistory::PixelHistory(uint32_t width, unsigned bits)
    : width_(width),
      bits_(bits),
      pixels_((size_t{window} + 4 * size_t{width} + 1) * bits / 16 + 4 * word_bytes),
      latest_(size_t{1} << table_bits),
      latest_short_(size_t{1} << short_table_bits),
      before_(width) {
  clear();
}

void PixelHistory::clear() {
  if (next_row_ == first_position) return;
  next_row_ = first_position;
  first_bit_ = size_t{first_position} * bits_ >> 2;
  std::fill(latest_.begin(), latest_.end(), 0);
  std::fill(latest_short_.begin(), latest_short_.end(), 0);
}

void PixelHistory::put_row(const uint8_t* packed, const uint8_t* image, DeflateWriter& out) {
  if (next_row_ > last_position) clear();
  row_ = next_row_;
  next_row_ += 4 * width_ + 1;
  store(packed);
  switch (bits_) {
    case 1:
      return put<1>(packed, image, out);
    case 2:
      return put<2>(packed, image, out);
    case 4:
      return put<4>(packed, image, out);
    default:
      return put<8>(packed, image, out);
  }
}

template <unsigned bits>
void PixelHistory::put(const uint8_t* packed, const uint8_t* image, DeflateWriter& out) {
  cut<bits>(packed, image, out);
}

void PixelHistory::store(const uint8_t* packed) {
  const size_t size = (size_t{width_} * bits_ + 7) / 8;
  if (bit_at(row_) / 8 + size + 2 * word_bytes > pixels_.size()) {
    const size_t begin = bit_at(row_ - window) / 8;
    std::memmove(pixels_.data(), &pixels_[begin], bit_at(row_) / 8 + 1 - begin);
    first_bit_ += 8 * begin;
  }
  const size_t bit = bit_at(row_);
  const unsigned offset = bit % 8;
  uint8_t* out = &pixels_[bit / 8];
  uint64_t carry = uint64_t{*out} >> (8 - offset) << (64 - offset) % 64;
  for (size_t i = 0; i < size; i += word_bytes, out += word_bytes) {
    const uint64_t word = load(packed + i);
    store_word(out, carry | word >> offset);
    carry = word << 1 << (63 - offset);
  }
  store_word(out, carry);
}

template <unsigned bits>
void PixelHistory::cut(const uint8_t* packed, const uint8_t* image, DeflateWriter& out) {
  constexpr uint32_t key_pixels = Keys<bits>::pixels, short_key_pixels = Keys<bits>::short_pixels;
  const uint32_t row = row_, width = width_;
  const uint32_t begins = begin_count(width, key_pixels), short_begins = begin_count(width, short_key_pixels);
  const uint8_t* const history = pixels_.data();
  const size_t first_bit = first_bit_;
  uint32_t* const latest = latest_.data();
  uint32_t* const latest_short = latest_short_.data();
  for (uint32_t column = 0, count = 0; column < width; column += count) {
    const uint32_t here = row + 4 * column;
    const uint64_t pixels = word_at(packed, size_t{column} * bits);
    const auto agrees = [&](uint32_t there, unsigned in_bits) {
      return here - there <= window &&
             (pixels ^ word_at(history, (size_t{there} * bits >> 2) - first_bit)) >> (64 - in_bits) == 0;
    };
    const auto enter = [&](uint32_t n) {
      for (uint32_t i = 0; i < n; ++i)
        latest[slot<bits * key_pixels, table_bits>(pixels << i * bits)] = here + 4 * i;
    };
    uint32_t there = column < begins ? latest[slot<bits * key_pixels, table_bits>(pixels)] : 0, there_short = 0;
    if (column < short_begins)
      there_short = std::exchange(latest_short[slot<bits * short_key_pixels, short_table_bits>(pixels)], here);
    count = key_pixels;
    if (!agrees(there, bits * key_pixels)) {
      there = there_short;
      count = short_key_pixels;
      if (!agrees(there, bits * short_key_pixels)) {
        count = 1;
        if (column < begins) enter(1);
        out.literals(image + size_t{4} * column, 4);
        continue;
      }
    }
    if (agrees(there, bits * count + more_bits)) {
      count = common_pixels<bits>(column, there);
      const uint32_t last = std::min(column + count, begins);
      for (uint32_t i = column; i < last; ++i)
        latest[slot<bits * key_pixels, table_bits>(word_at(packed, size_t{i} * bits))] = row + 4 * i;
    } else if (column + count <= begins) {
      enter(count);
    } else if (column < begins)
      enter(begins - column);
    out.match(4 * count, here - there);
  }
}

template <unsigned bits>
uint32_t PixelHistory::common_pixels(uint32_t column, uint32_t there) const {
  const uint32_t column_there = (there - first_position) % (4 * width_ + 1) / 4;
  const uint32_t most = width_ - std::max(column, column_there);
  const size_t bit = bit_at(row_) + size_t{column} * bits, bit_there = bit_at(there);
  for (uint32_t count = 0; count < most; count += sure_bits / bits) {
    const size_t skipped = size_t{count} * bits;
    const uint64_t differences = word_at(pixels_.data(), bit + skipped) ^ word_at(pixels_.data(), bit_there + skipped);
    const auto equal = static_cast<uint32_t>(std::countl_zero(differences)) / bits;
    if (equal < sure_bits / bits) return std::min(most, count + equal);
  }
  return most;
}

}  // namespace ombre::formats
