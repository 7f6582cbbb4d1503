// The borders of a slab of cells as bytes, for the files that processes share.
#pragma once

#include <string>
#include <string_view>

#include "surface/cells/grid_borders.h"

namespace ombre::jobs {

std::string slab_bytes(const surface::GridBorders& borders);
// Throws Error if the bytes end too early.
surface::GridBorders read_slab(std::string_view bytes);

}  // namespace ombre::jobs
