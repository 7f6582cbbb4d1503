#include "formats/images/pixel_history.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace ombre::formats {
namespace {

constexpr uint32_t window = DeflateWriter::window;
constexpr uint32_t first_position = 2 * window;        // beyond the window from position 0
constexpr uint32_t last_position = uint32_t{1} << 30;  // far below overflow
constexpr size_t word_bytes = sizeof(uint64_t);
constexpr size_t stored_rows = 8;  // more than the window needs, so that pixels rarely have to be moved

// Greatest number of keys. The window holds 8192 pixels, and most of half as many keys occur in it.
constexpr uint32_t most_keys = 4096;

constexpr uint32_t most_known_colours = 9;  // including void
constexpr uint32_t very_long = 32;          // pixels of a match
constexpr uint32_t equal_pixels = 4;        // distance of a match that repeats one pixel

constexpr uint32_t power(uint32_t base, uint32_t exponent) {
  uint32_t result = 1;
  for (; exponent > 0; --exponent) result *= base;
  return result;
}

// Returns the greatest number of digits, at least two, that form at most `count` numbers.
constexpr uint32_t digits_within(uint32_t base, uint32_t count) {
  uint32_t digits = 2;
  while (power(base, digits + 1) <= count) ++digits;
  return digits;
}

struct Found {
  uint32_t distance, pixels;

  bool is_out_of_reach() const { return distance > window; }
};

uint64_t load_pixels(const uint8_t* bytes) {
  static_assert(std::endian::native == std::endian::little);
  uint64_t word;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

}  // namespace

constexpr PixelHistory::KeyShape PixelHistory::shape_for(uint32_t colours) {
  const uint32_t pixels = digits_within(colours, most_keys), half = pixels / 2, behind_prefix = colours == 2 ? 2 : 1;
  return {pixels, pixels - behind_prefix, power(colours, behind_prefix), half, power(colours, pixels - half)};
}

PixelHistory::PixelHistory(uint32_t width, uint32_t colours)
    : width_(width),
      colours_(std::max(colours, 2U)),
      shape_(shape_for(colours_)),
      numbers_(window / 4 + stored_rows * (size_t{width} + 1) + 2 * word_bytes),
      keys_(size_t{width} + shape_.pixels),
      other_keys_(keys_.size()),
      latest_(power(colours_, shape_.pixels)) {
  clear();
}

void PixelHistory::clear() {
  if (next_row_ == first_position) return;
  next_row_ = first_position;
  first_ = first_position / 4;
  std::fill(latest_.begin(), latest_.end(), 0);
}

uint8_t* PixelHistory::begin_row() {
  if (next_row_ > last_position) clear();
  row_ = next_row_;
  next_row_ += 4 * width_ + 1;
  if (index(row_) + width_ + 2 * word_bytes > numbers_.size()) {
    const size_t begin = index(row_ - window);
    std::memmove(numbers_.data(), &numbers_[begin], index(row_) - begin);
    first_ += begin;
  }
  return &numbers_[index(row_)];
}

void PixelHistory::end_row(const uint8_t* image, DeflateWriter& out) {
  std::memset(&numbers_[index(row_) + width_], 0, 2 * word_bytes);
  make_keys(shape_.pixels, width_, keys_, other_keys_);
  // Loops of a constant length are faster.
  constexpr auto cutters = []<uint32_t... n>(std::integer_sequence<uint32_t, n...>) {
    return std::array{&PixelHistory::cut<0>, &PixelHistory::cut<0>, &PixelHistory::cut<n + 2>...};
  }
  (std::make_integer_sequence<uint32_t, most_known_colours - 1>());
  (this->*cutters[colours_ <= most_known_colours ? colours_ : 0])(image, out);
}

// Cuts a row into matches and literals; known_colours is 0 if the number of colours is not a constant.
template <uint32_t known_colours>
void PixelHistory::cut(const uint8_t* image, DeflateWriter& out) {
  constexpr KeyShape known = known_colours > 0 ? shape_for(known_colours) : KeyShape{};
  // Local copies cannot be changed by the stores below.
  const KeyShape shape = known_colours > 0 ? known : shape_;
  const uint32_t row = row_, width = width_, begins = begin_count();
  const uint16_t* const keys = keys_.data();
  uint32_t* const latest = latest_.data();
  const auto find_beginning = [&](uint32_t here, uint32_t key, uint32_t key_count, uint32_t pixels) {
    const uint32_t* const places = latest + (key - key % key_count);
    int32_t there = 0;  // signed, because vector instructions compare signed numbers
    for (uint32_t i = 0; i < key_count; ++i) there = std::max(there, static_cast<int32_t>(places[i]));
    return Found{here - static_cast<uint32_t>(there), pixels};
  };
  // Finds the next pixels: as many as a key has, else slightly fewer, else half as many; at the end of the row, those
  // that remain.
  const auto find = [&](uint32_t column, uint32_t here) {
    const uint32_t key = keys[column];
    if (column >= begins) {
      const uint32_t left = width - column;
      return find_beginning(here, key, power(colours_, shape.pixels - left), left);
    }
    Found found{here - latest[key], shape.pixels};
    if (found.is_out_of_reach()) found = find_beginning(here, key, shape.prefix_keys, shape.prefix_pixels);
    if (found.is_out_of_reach() && shape.half_pixels < shape.prefix_pixels)
      found = find_beginning(here, key, shape.half_keys, shape.half_pixels);
    return found;
  };

  uint32_t last_distance = 0;
  for (uint32_t column = 0, count = 0; column < width; column += count) {
    const uint32_t here = row + 4 * column;
    const Found found = find(column, here);
    count = found.pixels;
    if (found.is_out_of_reach()) {
      count = 1;
      out.literals(image + size_t{4} * column, 4);
    } else {
      if (found.distance == last_distance) {
        count = common_pixels(column, here - found.distance, count);
        if (count >= very_long && found.distance != equal_pixels) enter(column, column + count);
      }
      last_distance = found.distance;
      out.match(4 * count, found.distance);
    }
    // Only the last few columns are recorded: after a short match most of the others are recorded already, and for a
    // longer one they are enough.
    const uint32_t end = column + count, from = std::max(end, shape.pixels) - shape.pixels;
    if (end - from == shape.pixels && end <= begins)
      for (uint32_t i = 0; i < shape.pixels; ++i) latest[keys[from + size_t{i}]] = row + 4 * (from + i);
    else
      for (uint32_t i = from; i < std::min(end, begins); ++i) latest[keys[i]] = row + 4 * i;
  }
}

// Returns the number of columns at which a key can begin.
uint32_t PixelHistory::begin_count() const { return width_ - std::min(width_, shape_.pixels - 1); }

// Records the keys of all columns from `column` to `end`.
void PixelHistory::enter(uint32_t column, uint32_t end) {
  const uint32_t begins = begin_count(), row = row_;
  const uint16_t* const keys = keys_.data();
  uint32_t* const latest = latest_.data();
  for (; column < std::min(end, begins); ++column) latest[keys[column]] = row + 4 * column;
}

// Makes the keys of the first `count` columns; zeros follow the row. A key is made of two keys of half as many pixels,
// and one more digit if necessary.
void PixelHistory::make_keys(uint32_t pixels, uint32_t count, std::vector<uint16_t>& keys,
                             std::vector<uint16_t>& halves) const {
  const uint8_t* const digits = &numbers_[index(row_)];
  uint16_t* __restrict const out = keys.data();
  if (pixels == 1) {
    std::copy(digits, digits + count, out);
    return;
  }
  const uint32_t half = pixels / 2;
  make_keys(half, count + half, halves, keys);
  const uint16_t* __restrict const first = halves.data(), * __restrict const second = first + half;
  const uint8_t* __restrict const last = digits + size_t{2} * half;
  const auto factor = static_cast<uint16_t>(power(colours_, half)), base = static_cast<uint16_t>(colours_);
  if (pixels % 2 == 0)
    for (size_t i = 0; i < count; ++i) out[i] = static_cast<uint16_t>(first[i] * factor + second[i]);
  else
    for (size_t i = 0; i < count; ++i) out[i] = static_cast<uint16_t>((first[i] * factor + second[i]) * base + last[i]);
}

uint32_t PixelHistory::common_pixels(uint32_t column, uint32_t there, uint32_t known) const {
  const uint32_t column_there = (there - first_position) % (4 * width_ + 1) / 4;
  const uint32_t most = width_ - std::max(column, column_there);
  const uint8_t *const now = &numbers_[index(row_) + column], *const before = &numbers_[index(there)];
  for (uint32_t count = known; count < most; count += word_bytes)
    if (const uint64_t differences = load_pixels(now + count) ^ load_pixels(before + count))
      return std::min(most, count + static_cast<uint32_t>(std::countr_zero(differences)) / 8);
  return most;
}

}  // namespace ombre::formats
