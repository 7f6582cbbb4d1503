// How a photograph is meant to be turned: what its camera noted.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "jpeg/jpeg_image.h"

namespace ombre::jpeg {

// Returns the orientation in the bytes of a JPEG file, 1 to 8, as "Exif 2.32" (CIPA DC-008-2019, tag 274) numbers them;
// 1, as stored, if it has none.
int orientation_of(std::string_view bytes);

// Returns the picture as it is meant to be seen.
Picture turned(Picture stored, int orientation);

}  // namespace ombre::jpeg
