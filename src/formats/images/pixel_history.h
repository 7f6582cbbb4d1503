// The pixels of the last image rows, with the latest places of short sequences of pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "formats/containers/deflate.h"

namespace ombre::formats {

// Deflates rows of four-byte pixels, each row preceded by its filter byte. Here a pixel is a small number, and several
// of them are the digits of another number, their key.
//
// A dithered row only contains information on which of the earlier sequences comes next. So it is encoded as matches of
// a fixed number of pixels, each with the latest place of their key. Only a match with the same distance as the
// previous one is extended to its end. Extending all would save one or two per cent of the bytes, but take more time.
class PixelHistory {
 public:
  // Constructs a history for pixels that are numbers below `colours`.
  PixelHistory(uint32_t width, uint32_t colours);

  // Forgets all rows, so that the following ones do not repeat them.
  void clear();
  // Returns where the caller writes the numbers of the next row, before it calls end_row() to encode them.
  uint8_t* begin_row();
  void end_row(const uint8_t* image, DeflateWriter& out);

 private:
  // How many pixels a key holds, and how many keys begin alike in the first `prefix_pixels` or `half_pixels` of them.
  struct KeyShape {
    uint32_t pixels, prefix_pixels, prefix_keys, half_pixels, half_keys;
  };
  static constexpr KeyShape shape_for(uint32_t colours);

  uint32_t begin_count() const;
  void make_keys(uint32_t pixels, uint32_t count, std::vector<uint16_t>& keys, std::vector<uint16_t>& halves) const;
  template <uint32_t known_colours>
  void cut(const uint8_t* image, DeflateWriter& out);
  void enter(uint32_t column, uint32_t end);
  uint32_t common_pixels(uint32_t column, uint32_t there, uint32_t known) const;
  // Returns the index in `numbers_` of the pixel at a position.
  size_t index(uint32_t position) const { return position / 4 - first_; }

  uint32_t width_, colours_;
  KeyShape shape_;
  // Pixels as numbers. A position is an offset in bytes in the image data. Rows are contiguous, as in the image data;
  // the filter byte before a row counts as a quarter of a pixel, rounded.
  std::vector<uint8_t> numbers_;
  size_t first_ = 0;
  uint32_t row_ = 0, next_row_ = 0;
  // Keys of the newest row: the pixels from each column on as a number.
  std::vector<uint16_t> keys_;
  std::vector<uint16_t> other_keys_;  // keys of half the pixels, from which they are made
  // The latest position of each key, or 0.
  std::vector<uint32_t> latest_;
};

}  // namespace ombre::formats
