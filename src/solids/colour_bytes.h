// Colours of solids as bytes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "solids/tree.h"

namespace ombre::solids {

inline std::array<uint8_t, 4> bytes_of(const Colour& colour) {
  std::array<uint8_t, 4> bytes{};
  for (size_t n = 0; n < bytes.size(); ++n)
    bytes[n] = static_cast<uint8_t>(std::lround(255 * std::clamp(colour[n], 0.0, 1.0)));
  return bytes;
}

}  // namespace ombre::solids
