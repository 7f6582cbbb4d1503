// The pixels of the last image rows, and where a few of them in a row stood before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "formats/containers/deflate.h"

namespace ombre::formats {

// Deflates rows of four-byte pixels, each behind a byte that says how the row is stored. Here a pixel is a small
// number, and a few of them are the digits of another, their key.
//
// A dithered row says nothing new but which of the stretches seen before comes next. So it becomes matches of
// a fixed number of pixels, each with the latest place where they stood; only one as far back as the match before is
// followed to its end. Following all would save a byte or two in a hundred, but cost more time.
class PixelHistory {
 public:
  // Pixels are numbers below `colours`.
  PixelHistory(uint32_t width, uint32_t colours);

  // What follows repeats nothing that came before.
  void clear();
  // Where to put the numbers of the next row, before it ends with its image.
  uint8_t* begin_row();
  void end_row(const uint8_t* image, DeflateWriter& out);

 private:
  // How many pixels a key has, and how many keys begin with the same pixels, for two such numbers of pixels.
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
  // Where in `numbers_` the pixel at a position is.
  size_t index(uint32_t position) const { return position / 4 - first_; }

  uint32_t width_, colours_;
  KeyShape shape_;
  // Positions are bytes of the image data. Rows follow each other here as they do there; the byte before a row
  // takes a quarter of a pixel, rounded.
  std::vector<uint8_t> numbers_;
  size_t first_ = 0;
  uint32_t row_ = 0, next_row_ = 0;
  // Of the newest row: from each column on, the next pixels as a number.
  std::vector<uint16_t> keys_;
  std::vector<uint16_t> other_keys_;  // from which they are made
  // By key: where it stood at last, or 0.
  std::vector<uint32_t> latest_;
};

}  // namespace ombre::formats
