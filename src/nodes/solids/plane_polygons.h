// Polygons of a design, which are checked and mapped to the plane in which they lie.
#pragma once

#include <optional>

#include "base/math/polygons.h"
#include "design/values.h"

namespace ombre::nodes {

// Removes points that repeat the one before. Returns nothing and adds a diagnostic if the ring bounds no area.
std::optional<Ring> checked_ring(Ring ring, const std::string& what, const design::Reader& reader);

// Polygons and the plane in which they are counterclockwise. Points of two numbers lie in XY, seen from above.
struct PlanePolygons {
  Polygons polygons;
  Affine here_from_plane;  // z is the normal

  // Returns nothing and adds a diagnostic if points do not lie in one plane or bound no area.
  static std::optional<PlanePolygons> read(const design::Points& outer, const std::vector<design::Points>& holes,
                                           const design::Reader& reader);
};

}  // namespace ombre::nodes
