// Paths as field sources.
#pragma once

#include <vector>

#include "base/vec.h"
#include "program/field_source.h"

namespace ombre::importing {

// Channel "distance": mm to the nearest point of the straight lines from each of two points or more to the next.
program::SourceField make_path_source(const std::vector<Vec3>& points);

}  // namespace ombre::importing
