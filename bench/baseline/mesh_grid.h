// A mesh as the published method keeps it: distances sampled on a grid near the surface, read back by
// trilinear interpolation.
#pragma once

#include <string>

#include "node.h"

namespace baseline {

// Reads a binary STL. Nodes of the grid are `spacing` apart, or wider where the grid would grow too large.
NodePtr mesh(const std::string& path, double spacing, size_t material);

}  // namespace baseline
