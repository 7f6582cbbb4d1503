// The colours of a stack of layers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/math/run.h"
#include "formats/images/rgba.h"

namespace ombre::formats {

// Returns the least of 1, 2, 4 and 8 bits that can distinguish this many values.
int bits_for(size_t count);

// A palette whose entry 0 is void, followed by the materials in the order in which they are added. All layers of a job
// share one palette, so that a number has the same meaning in all of them.
class Palette {
 public:
  explicit Palette(Rgba background = {0, 0, 0, 0});

  // Adds a material; each id at most once, and not 0.
  void add(MaterialId id, Rgba colour);
  // Returns a palette of the first `count` entries, or of all if there are fewer.
  Palette first(size_t count) const;

  const std::vector<Rgba>& colours() const { return colours_; }
  // Returns the ids by entry; void is 0.
  const std::vector<MaterialId>& ids() const { return ids_; }
  // Returns the entry of an added material.
  uint8_t entry(MaterialId id) const;
  // Returns the number of bits that can hold every entry.
  int bit_depth() const;

 private:
  std::vector<Rgba> colours_;
  std::vector<MaterialId> ids_;
  std::array<uint8_t, 256> entries_{};
  std::array<bool, 256> known_{};
};

// Returns the luma of a colour (Rec. 601), without alpha.
uint8_t luminance(Rgba colour);

}  // namespace ombre::formats
