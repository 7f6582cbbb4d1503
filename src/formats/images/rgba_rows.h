// Encodes rows of voxels as RGBA image rows, in units of whole pixels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/math/run.h"
#include "formats/containers/zlib_stream.h"
#include "formats/images/palette.h"
#include "formats/images/pixel_history.h"
#include "formats/images/stretch_history.h"

namespace ombre::formats {

// Smooth rows are written as differences to the row above, stretch by stretch, without generating their bytes. Dithered
// rows repeat earlier data wherever a few pixels are equal.
class RgbaRows {
 public:
  // Constructs an encoder; `materials` are those that occur, at least one.
  RgbaRows(uint32_t width, const Palette& palette, std::vector<MaterialId> materials, bool flip_x, ZlibStream& out);

  // Adds the next row, from the top.
  void put(const RowView& row);

 private:
  static constexpr size_t few = 16;  // number of materials that vector instructions can look up

  void put_smooth(const RowView& row);
  void set_runs(const RowView& row);
  void put_difference();
  void put_runs();
  void put_dense(const RowView& row);
  void set_numbers(const RowView& row, uint8_t* numbers) const;
  void set_image(const uint8_t* numbers);
  void put_filter(uint8_t filter);
  void put_stretch(Rgba pixel, uint32_t count);

  uint32_t width_;
  bool flip_x_;
  std::vector<MaterialId> materials_;
  std::array<uint8_t, 256> number_of_{};    // by id: index in `materials_`
  std::array<Rgba, 256> colours_{};         // by id
  std::array<Rgba, few> colours_of_few_{};  // by index in `materials_`
  ZlibStream& out_;
  std::vector<Run> runs_, runs_above_;  // runs of smooth rows
  StretchHistory stretches_;
  std::vector<uint8_t> image_;  // bytes of a dithered row
  PixelHistory history_;
};

}  // namespace ombre::formats
