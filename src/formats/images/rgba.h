// Colours of files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ombre::formats {

using Rgba = std::array<uint8_t, 4>;  // red, green, blue in sRGB, and alpha; not premultiplied

// Returns the four parts from 0 to 1.
inline std::array<float, 4> shares_of(const Rgba& colour) {
  std::array<float, 4> shares;
  for (size_t n = 0; n < shares.size(); ++n) shares[n] = static_cast<float>(colour[n]) / 255.0F;
  return shares;
}

// Parses "#RRGGBB" or "#RRGGBBAA"; null if the text is neither.
std::optional<Rgba> parse_colour(std::string_view text);

}  // namespace ombre::formats
