// Distinguishes smooth rows from dithered ones.
#pragma once

#include "base/math/run.h"

namespace ombre::formats {

// Returns true if the material changes at most every 32 voxels on average, judged by the first dense voxels.
bool is_smooth(const RowView& row, uint32_t width);

}  // namespace ombre::formats
