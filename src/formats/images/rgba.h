// Colours of files.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ombre::formats {

using Rgba = std::array<uint8_t, 4>;  // red, green, blue in sRGB, and alpha; not premultiplied

// Parses "#RRGGBB" or "#RRGGBBAA"; null if the text is neither.
std::optional<Rgba> parse_colour(std::string_view text);

}  // namespace ombre::formats
