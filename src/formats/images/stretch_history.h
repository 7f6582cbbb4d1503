// The stretches of equal pixels in the last image rows.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/containers/deflate.h"
#include "formats/images/palette.h"

namespace ombre::formats {

// Deflates rows that are mostly zero, such as differences of smooth rows. The other pixels are edges that moved. Many
// move as far as an earlier one; then a match covers the stretch and the zeros that follow it.
class StretchHistory {
 public:
  StretchHistory();

  // Forgets all rows, so that the following ones do not repeat them.
  void clear();
  // put_filter() adds the filter byte of a row, put() equal pixels.
  void put_filter(uint8_t filter, DeflateWriter& out);
  void put(Rgba pixel, uint32_t count, DeflateWriter& out);

 private:
  // A stretch of equal pixels, followed by `zeros` zero pixels.
  struct Stretch {
    uint32_t position = 0;  // in bytes; 0 if there is none
    Rgba pixel{};
    uint32_t count = 0, zeros = 0;
  };

  void put_zeros(uint32_t count, DeflateWriter& out);
  void put_edge(Rgba pixel, uint32_t count, DeflateWriter& out);

  std::vector<Stretch> latest_;  // by hash of pixel and count
  uint32_t position_ = 0;
  Stretch* last_ = nullptr;                 // null if something follows it already
  uint32_t more_zeros_ = 0, distance_ = 0;  // bytes by which the last match can be extended, and its distance
};

}  // namespace ombre::formats
