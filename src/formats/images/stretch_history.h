// Stretches of equal pixels in the last image rows.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/containers/deflate.h"
#include "formats/images/palette.h"

namespace ombre::formats {

// Deflates rows that are mostly zero, as differences of smooth rows are. What is not zero are edges that moved.
// Many move as far as one before, and then a match covers the stretch and zeros behind it.
class StretchHistory {
 public:
  StretchHistory();

  // What follows repeats nothing that came before.
  void clear();
  // The next bytes: one that says how a row is stored, or equal pixels.
  void put_filter(uint8_t filter, DeflateWriter& out);
  void put(Rgba pixel, uint32_t count, DeflateWriter& out);

 private:
  // Zeros are pixels that follow.
  struct Stretch {
    uint32_t position = 0;  // in bytes, or 0
    Rgba pixel{};
    uint32_t count = 0, zeros = 0;
  };

  void put_zeros(uint32_t count, DeflateWriter& out);
  void put_edge(Rgba pixel, uint32_t count, DeflateWriter& out);

  std::vector<Stretch> latest_;  // by hash of pixel and count
  uint32_t position_ = 0;
  Stretch* last_ = nullptr;                 // if nothing came behind it yet
  uint32_t more_zeros_ = 0, distance_ = 0;  // bytes that the last match can go on for
};

}  // namespace ombre::formats
