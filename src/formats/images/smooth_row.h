// Tells smooth rows from dithered ones.
#pragma once

#include "base/math/run.h"

namespace ombre::formats {

// Whether the material changes at most every 32 voxels on average, as far as the first loose ones tell.
bool is_smooth(const RowView& row, uint32_t width);

}  // namespace ombre::formats
