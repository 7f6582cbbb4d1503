// Common parts of the two tetrahedral meshers by CGAL.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "solids/tetrahedra.h"

namespace ombre::solids {

// Radii of the circumscribed balls of facets and cells, as shares of the element size; with them the mean edge is about
// as long as the size.
inline constexpr double facet_share = 0.8, cell_share = 0.8;
inline constexpr double least_angle = 25, most_radius_to_edge = 2.2;
// Angles between faces that mending tries to reach one after another, and limits on the queries for each.
inline constexpr std::array sliver_degrees = {1.0, 2.0, 4.0, 8.0, 12.0};
inline constexpr uint64_t questions_to_mend = 500'000, questions_to_mend_of_cell = 100;
// Greatest distance of surface points from the surface, as a share of the size.
inline constexpr double surface_error = 1e-4;

// Counts the mesher's queries, and stops it by throwing Enough if they exceed the limit.
class Questions {
 public:
  struct Enough {};
  void allow(uint64_t more) { left_ = more; }
  void allow_all() { left_ = std::numeric_limits<uint64_t>::max(); }
  void count() {
    if (left_-- == 0) throw Enough();
  }

 private:
  uint64_t left_ = std::numeric_limits<uint64_t>::max();
};

// Sorts points and tetrahedra as Tetrahedra requires.
void put_in_order(Tetrahedra& made);

// Makes the tetrahedra of a periodic request. Throws Error and Questions::Enough.
Tetrahedra make_periodic(const TetrahedraRequest& request);

}  // namespace ombre::solids
