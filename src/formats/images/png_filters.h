// The filter byte before each row of a PNG image, which defines what its bytes are relative to.
#pragma once

#include <cstdint>

namespace ombre::formats {

inline constexpr uint8_t filter_none = 0, filter_up = 2;

}  // namespace ombre::formats
