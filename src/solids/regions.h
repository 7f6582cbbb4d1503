// Operations on regions of a plane. Coordinates are rounded to 2^-32 mm, and more coarsely beyond a kilometre.
#pragma once

#include <span>
#include <vector>

#include "solids/solid.h"

namespace ombre::solids {

// Returns the points enclosed by an odd number of rings; rings may cross, and have either orientation.
Region region_of(std::span<const Ring> rings);
// Returns the points around which the winding number of the rings is not 0.
Region wound_region_of(std::span<const Ring> rings);

Region unite(std::span<const Region> regions);
Region intersect(const Region& a, const Region& b);
Region subtract(const Region& a, const Region& b);
Region moved(const Region& region, const Affine& map);  // by the map's effect in the plane
Region offset(const Region& region, const Offset& by);
// Removes details narrower than the distance: points that lie closer together, slits, slivers, and corners of nearly
// straight lines.
Region cleaned(const Region& region, double distance_mm);
Region fill(const Region& region);  // removes its holes
Region hull(std::span<const Region> regions);
// Returns the Minkowski sum: all sums of a point of `a` and a point of `b`.
Region minkowski(const Region& a, const Region& b);

}  // namespace ombre::solids
