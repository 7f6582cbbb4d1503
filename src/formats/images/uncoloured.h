// The colour of materials without one, in formats that require a colour.
#pragma once

#include "formats/images/rgba.h"

namespace ombre::formats {

// A colour that means "no colour" in files written by this project: a gray that is not quite opaque, so rarely used
// otherwise. Readers of solids treat it as none.
inline constexpr Rgba uncoloured{128, 128, 128, 254};

}  // namespace ombre::formats
