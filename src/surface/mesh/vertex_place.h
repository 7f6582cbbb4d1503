// Places the vertices of leaves.
#pragma once

#include "base/math/box.h"
#include "surface/mesh/dual_mesh.h"

namespace ombre::surface {

// Returns the box around a cell in which its vertex may lie; a sharp edge between the cell's crossings may lie slightly
// outside of the cell. Places are in cells of the level.
Box room_of(const CellTree& tree, const CellPlace& place, int level);

// Returns the point nearest to the planes around the vertex, inside the box of room_of().
Vec3 place_of(const DualVertex& vertex, const CellTree& tree);

}  // namespace ombre::surface
