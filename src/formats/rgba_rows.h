// Rows of voxels to RGBA image rows, seen as whole pixels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/run.h"
#include "formats/equal_bytes.h"
#include "formats/palette.h"
#include "formats/pixel_history.h"
#include "formats/zlib_stream.h"

namespace ombre::formats {

// Smooth rows are written as the difference to the row above, stretch by stretch, without making their
// bytes. Dithered rows repeat what was written before wherever a few pixels agree.
class RgbaRows {
 public:
  RgbaRows(uint32_t width, const Palette& palette, bool flip_x, ZlibStream& out);

  // From the top.
  void put(const RowView& row);

 private:
  void put_smooth(const RowView& row);
  void set_runs(const RowView& row);
  void put_difference();
  void put_runs();
  void put_dense(const RowView& row, size_t alike);
  void put_filter(uint8_t filter);
  void put_stretch(Rgba pixel, uint32_t count);

  uint32_t width_;
  bool flip_x_;
  std::array<Rgba, 256> colours_{};  // by id
  ZlibStream& out_;
  EqualBytes equal_;
  std::vector<Run> runs_, runs_above_;  // of smooth rows
  uint64_t dense_rows_ = 0;
  PixelHistory history_;
  std::vector<MaterialId> voxels_;
  std::vector<uint8_t> bytes_;
};

}  // namespace ombre::formats
