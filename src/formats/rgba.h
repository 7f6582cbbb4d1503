// Colours of files.
#pragma once

#include <array>
#include <cstdint>

namespace ombre::formats {

using Rgba = std::array<uint8_t, 4>;  // red, green, blue in sRGB, alpha; not premultiplied

}  // namespace ombre::formats
