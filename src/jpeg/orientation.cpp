#include "jpeg/orientation.h"

#include <array>
#include <cstring>

namespace ombre::jpeg {
namespace {

// Numbers in bytes, of either order; 0 beyond their end.
struct Bytes {
  std::string_view bytes;
  bool is_little = false;

  uint32_t number(size_t at, size_t size) const {
    if (at > bytes.size() || size > bytes.size() - at) return 0;
    uint32_t value = 0;
    for (size_t n = 0; n < size; ++n)
      value = value << 8 | static_cast<unsigned char>(bytes[at + (is_little ? size - 1 - n : n)]);
    return value;
  }
};

// Returns the TIFF structure of the segment with Exif, or nothing.
std::string_view exif_of(std::string_view file) {
  using namespace std::string_view_literals;
  constexpr uint32_t first_marker = 0xFFC0, start_of_scan = 0xFFDA, application_1 = 0xFFE1;
  constexpr std::string_view mark = "Exif\0\0"sv;
  const Bytes numbers{file};
  for (size_t at = 2;;) {
    const uint32_t marker = numbers.number(at, 2), length = numbers.number(at + 2, 2);
    if (marker < first_marker || marker == start_of_scan || length < 2) return {};
    const std::string_view segment = file.substr(std::min(at + 4, file.size()), length - 2);
    if (marker == application_1 && segment.starts_with(mark)) return segment.substr(mark.size());
    at += 2 + size_t{length};
  }
}

// How the picture that is seen is taken from the stored one: rows and columns are exchanged, then reversed.
struct Turn {
  bool exchanges = false, reverses_columns = false, reverses_rows = false;
};
constexpr std::array<Turn, 8> turns{{{false, false, false},
                                     {false, true, false},
                                     {false, true, true},
                                     {false, false, true},
                                     {true, false, false},
                                     {true, false, true},
                                     {true, true, true},
                                     {true, true, false}}};

}  // namespace

int orientation_of(std::string_view bytes) {
  Bytes exif{exif_of(bytes)};
  exif.is_little = exif.bytes.starts_with("II");
  constexpr uint32_t tiff_number = 42, tag_of_orientation = 274, entry_bytes = 12;
  if (exif.number(2, 2) != tiff_number) return 1;
  const size_t directory = exif.number(4, 4), entries = exif.number(directory, 2);
  for (size_t n = 0; n < entries; ++n) {
    const size_t at = directory + 2 + entry_bytes * n;
    if (exif.number(at, 2) != tag_of_orientation) continue;
    const uint32_t value = exif.number(at + 8, 2);
    return value >= 1 && value <= turns.size() ? static_cast<int>(value) : 1;
  }
  return 1;
}

Picture turned(Picture stored, int orientation) {
  const Turn turn = turns.at(static_cast<size_t>(orientation - 1));
  if (orientation == 1) return stored;
  Picture seen{stored.width, stored.height, std::vector<uint8_t>(stored.rgba.size())};
  if (turn.exchanges) std::swap(seen.width, seen.height);
  for (size_t row = 0; row < seen.height; ++row)
    for (size_t column = 0; column < seen.width; ++column) {
      const size_t x = turn.exchanges ? row : column, y = turn.exchanges ? column : row;
      const size_t from_x = turn.reverses_columns ? stored.width - 1 - x : x;
      const size_t from_y = turn.reverses_rows ? stored.height - 1 - y : y;
      std::memcpy(&seen.rgba[4 * (row * seen.width + column)], &stored.rgba[4 * (from_y * stored.width + from_x)], 4);
    }
  return seen;
}

}  // namespace ombre::jpeg
