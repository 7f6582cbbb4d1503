// Polygons of a design: checked, and laid into the plane in which they lie.
#pragma once

#include <optional>

#include "base/math/polygons.h"
#include "design/values.h"

namespace ombre::nodes {

// A ring, without points that repeat the one before. Nothing, and a diagnostic, for what bounds no area.
std::optional<Ring> checked_ring(Ring ring, const std::string& what, const design::Reader& reader);

// Polygons and the plane around which they are right-handed; points of two numbers lie in XY, seen from above.
struct PlanePolygons {
  Polygons polygons;
  Affine here_from_plane;  // z: along the normal

  // Nothing, and a diagnostic, when points do not lie in a plane or bound no area.
  static std::optional<PlanePolygons> read(const design::Points& outer, const std::vector<design::Points>& holes,
                                           const design::Reader& reader);
};

}  // namespace ombre::nodes
