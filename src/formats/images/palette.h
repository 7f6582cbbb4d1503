// The colours of a stack of layers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/math/run.h"
#include "formats/images/rgba.h"

namespace ombre::formats {

// The least of 1, 2, 4, 8 bits that tells so many things apart.
int bits_for(size_t count);

// Entry 0 is void, then come the materials in the order added. All layers of a job share one palette, so that
// a number means the same in all of them.
class Palette {
 public:
  explicit Palette(Rgba background = {0, 0, 0, 0});

  // Each id once, and not 0.
  void add(MaterialId id, Rgba colour);
  // As many entries from 0 on, or all if there are fewer.
  Palette first(size_t count) const;

  const std::vector<Rgba>& colours() const { return colours_; }
  // By entry; void is 0.
  const std::vector<MaterialId>& ids() const { return ids_; }
  // The entry of a material that was added.
  uint8_t entry(MaterialId id) const;
  // That hold every entry.
  int bit_depth() const;

 private:
  std::vector<Rgba> colours_;
  std::vector<MaterialId> ids_;
  std::array<uint8_t, 256> entries_{};
  std::array<bool, 256> known_{};
};

// Luma of a colour (Rec. 601), alpha aside.
uint8_t luminance(Rgba colour);

}  // namespace ombre::formats
