// The pixels of the last image rows, and where a few of them in a row stood before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "formats/deflate.h"

namespace ombre::formats {

// Deflates rows of four-byte pixels, each behind a byte that says how the row is stored. Here a pixel is a small
// number of 1, 2, 4 or 8 bits, so that a word holds many: they are looked up and compared together.
//
// A dithered row says nothing new but which of the stretches seen before comes next. So it becomes matches of
// a fixed number of pixels, each with the latest place where they stood; only those that go on far are followed to
// their end. Following all would save one byte in a hundred, but then each match waits for the one before.
class PixelHistory {
 public:
  PixelHistory(uint32_t width, unsigned bits);

  // What follows repeats nothing that came before.
  void clear();
  // The next row: packed, the first pixel in the highest bits, with eight more bytes that can be read; and as
  // in the image.
  void put_row(const uint8_t* packed, const uint8_t* image, DeflateWriter& out);

 private:
  template <unsigned bits>
  void put(const uint8_t* packed, const uint8_t* image, DeflateWriter& out);
  void store(const uint8_t* packed);
  template <unsigned bits>
  void cut(const uint8_t* packed, const uint8_t* image, DeflateWriter& out);
  template <unsigned bits>
  uint32_t common_pixels(uint32_t column, uint32_t there) const;
  // The bit of `pixels_` at which the pixel at a position begins.
  size_t bit_at(uint32_t position) const { return (size_t{position} * bits_ >> 2) - first_bit_; }

  uint32_t width_;
  unsigned bits_;
  // Positions are bytes of the image data. Rows follow each other in these bits as they do there; the byte
  // before a row takes a quarter of a pixel, rounded.
  std::vector<uint8_t> pixels_;
  size_t first_bit_ = 0;
  uint32_t row_ = 0, next_row_ = 0;
  // By their hash: where stretches of pixels began at last, or 0.
  std::vector<uint32_t> latest_, latest_short_;
  std::vector<uint32_t> before_;  // by column of the newest row: where its next pixels stood before, or 0
};

}  // namespace ombre::formats
