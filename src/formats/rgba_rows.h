// Rows of voxels to RGBA image rows, seen as whole pixels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/run.h"
#include "formats/palette.h"
#include "formats/pixel_history.h"
#include "formats/png_rows.h"
#include "formats/stretch_history.h"
#include "formats/zlib_stream.h"

namespace ombre::formats {

// Smooth rows are written as the difference to the row above, stretch by stretch, without making their
// bytes. Dithered rows repeat what was written before wherever a few pixels agree.
class RgbaRows {
 public:
  // `numbers` tells the materials apart that occur.
  RgbaRows(uint32_t width, const Palette& palette, const Samples& numbers, bool flip_x, ZlibStream& out);

  // From the top.
  void put(const RowView& row);

 private:
  void put_smooth(const RowView& row);
  void set_runs(const RowView& row);
  void put_difference();
  void put_runs();
  void put_dense(const RowView& row);
  void expand();
  template <size_t pixels_in_byte>
  void expand_bytes();
  void put_filter(uint8_t filter);
  void put_stretch(Rgba pixel, uint32_t count);

  uint32_t width_;
  unsigned bits_;  // that tell materials apart
  bool flip_x_;
  std::array<Rgba, 256> colours_{};  // by id
  ZlibStream& out_;
  std::vector<Run> runs_, runs_above_;  // of smooth rows
  StretchHistory stretches_;
  // A dithered row in numbers and in colours.
  RowPacker packer_;
  std::vector<uint8_t> numbers_of_byte_;  // of a byte of packed numbers
  std::vector<Rgba> colours_of_byte_;
  std::vector<uint8_t> packed_, numbers_, image_;
  PixelHistory history_;
};

}  // namespace ombre::formats
