// The pixels of the last image rows, and where a few of them in a row stood before.
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
  // What begins like the newest row at `column`, and does not go on behind the end of either row.
  Match find(uint32_t column);

  // How many pixels a match is found by, at most 8: the more, the longer matches are and the rarer.
  void set_key_pixels(uint32_t count) { key_pixels_ = count; }

 private:
  // The latest position of the pixels that have some hash, or 0.
  struct Table {
    explicit Table(unsigned bits) : shift(64 - bits), positions(size_t{1} << bits) {}

    // Enters `count` neighbours from `position` on, and puts what stood there into `before`.
    void exchange(const MaterialId* pixels, uint32_t count, uint32_t position, uint64_t mask, uint32_t* before);

    unsigned shift;
    std::vector<uint32_t> positions;
  };

  void restart();
  Match match(uint32_t column, uint32_t there) const;
  const MaterialId* at(uint32_t position) const { return pixels_.data() + (position - first_); }

  uint32_t width_, kept_rows_, key_pixels_ = 8;
  std::vector<MaterialId> pixels_;
  // Positions count pixels from 1 on.
  uint32_t first_ = 1;          // of pixels_[0]
  uint32_t oldest_ = 1;         // of the first pixel that may be repeated
  uint32_t row_ = 1, end_ = 1;  // where the newest row begins and ends
  Table long_keys_, short_keys_;
  std::vector<uint32_t> before_;  // by column of the newest row: where its next pixels stood before
};

}  // namespace ombre::formats
