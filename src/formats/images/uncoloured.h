// Materials without a colour, in formats that need one.
#pragma once

#include "formats/images/rgba.h"

namespace ombre::formats {

// What stands for "no colour" in files that we write: a gray that is not quite opaque, and so hardly anybody's own.
// Readers of solids take it for none.
inline constexpr Rgba uncoloured{128, 128, 128, 254};

}  // namespace ombre::formats
