// The pixels of the last image rows, and where a few of them in a row stood last.
#pragma once

#include <cstdint>
#include <vector>

#include "base/run.h"

namespace ombre::formats {

// Rows of four-byte pixels, each behind a byte that says how the row is stored.
class PixelHistory {
 public:
  explicit PixelHistory(uint32_t width);

  void clear();
  void add_row(const MaterialId* voxels);

  struct Match {
    uint32_t pixels = 0;    // 0 if there is none
    uint32_t distance = 0;  // in bytes
  };
  // What begins like the newest row at `column` and ends with the row at the latest.
  Match find(uint32_t column) const;
  // Makes pixels of the newest row known to later calls of `find`.
  void learn(uint32_t begin, uint32_t end);

 private:
  static constexpr uint32_t key_pixels = 8;
  static constexpr unsigned table_bits = 13;

  const MaterialId* at(uint32_t position) const { return pixels_.data() + (position - first_); }
  size_t slot(uint32_t position) const;

  uint32_t width_, kept_rows_;
  std::vector<MaterialId> pixels_;
  // Positions count pixels from 1 on.
  uint32_t first_ = 1;               // of pixels_[0]
  uint32_t oldest_ = 1;              // of the first pixel that may be repeated
  uint32_t row_ = 1, end_ = 1;       // where the newest row begins and ends
  std::vector<uint32_t> positions_;  // where pixels with some hash stood last, or 0
};

}  // namespace ombre::formats
