// Rows of runs to the bytes of PNG rows.
#pragma once

#include <cstdint>
#include <vector>

#include "base/run.h"
#include "formats/png.h"

namespace ombre::formats {

// Packs the rows of one layer, a row at a time, into a buffer of its own.
class RowPacker {
 public:
  RowPacker(uint32_t width, const Palette& palette, const PngLayout& layout);

  const std::vector<uint8_t>& pack(const RowView& row);

 private:
  void put_indexed(uint64_t begin, const Run& run);
  void put_rgba(uint64_t begin, const Run& run);

  uint32_t width_;
  const Palette& palette_;
  const PngLayout& layout_;
  int bit_depth_;
  std::vector<uint8_t> bytes_;
};

}  // namespace ombre::formats
