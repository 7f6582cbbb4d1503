// Operations on regions of a plane. Coordinates are rounded to 2^-32 mm, coarser beyond a kilometre.
#pragma once

#include <span>
#include <vector>

#include "solids/solid.h"

namespace ombre::solids {

// What an odd number of the rings goes round; rings may cross, and turn either way.
Region region_of(std::span<const Ring> rings);
// What a region of these rings covers where the winding number is not 0.
Region wound_region_of(std::span<const Ring> rings);

Region unite(std::span<const Region> regions);
Region intersect(const Region& a, const Region& b);
Region subtract(const Region& a, const Region& b);
Region moved(const Region& region, const Affine& map);  // by what the map does in the plane
Region offset(const Region& region, const Offset& by);
// Leaves out what is narrower than the distance: points that lie closer, slits, slivers, and corners of nearly straight
// lines.
Region cleaned(const Region& region, double distance_mm);
Region fill(const Region& region);  // without its holes
Region hull(std::span<const Region> regions);
// All sums of a point of the one and a point of the other.
Region minkowski(const Region& a, const Region& b);

}  // namespace ombre::solids
