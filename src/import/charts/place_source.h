// Places on a patch of a surface, as fields over space.
#pragma once

#include <string>

#include "import/charts/surface_patch.h"
#include "program/field_source.h"

namespace ombre::importing {

// Returns a source with what belongs to the point of the patch that is nearest to a place. "u" and "v" are its
// coordinates (mm), "x", "y" and "z" the point itself. "normal_x" to "normal_z" are the normal there, interpolated
// between those of the corners. "border" is its distance from the patch's border in mm. "distance" is the way to it in
// mm, positive on the outer side of the surface. Sign by the normals of faces, edges and corners: J. Baerentzen and H.
// Aanaes, "Signed distance computation using the angle weighted pseudonormal", IEEE Transactions on Visualization and
// Computer Graphics 11, 2005. `content` is the hash of what the patch is made of.
program::SourceField make_place_source(std::string name, SurfacePatch patch, const Hash& content);

}  // namespace ombre::importing
