// The byte before each row of a PNG image: what its bytes are differences to.
#pragma once

#include <cstdint>

namespace ombre::formats {

inline constexpr uint8_t filter_none = 0, filter_up = 2;

}  // namespace ombre::formats
