// Where the vertex of a leaf lies.
#pragma once

#include "base/math/box.h"
#include "surface/mesh/dual_mesh.h"

namespace ombre::surface {

// The room around a cell in which its vertex may lie: sharp edges between its crossings may be a little outside of it.
// Places are in units of the level.
Box room_of(const CellTree& tree, const CellPlace& place, int level);

// Where it is nearest to the planes around it, as far as the room goes.
Vec3 place_of(const DualVertex& vertex, const CellTree& tree);

}  // namespace ombre::surface
