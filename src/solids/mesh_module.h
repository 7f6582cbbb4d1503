// What both meshers of tetrahedra by CGAL have in common.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "solids/tetrahedra.h"

namespace ombre::solids {

// Shares of the element size: radii of the balls around facets and cells, so that the mean edge has about the size.
inline constexpr double facet_share = 0.8, cell_share = 0.8;
inline constexpr double least_angle = 25, most_radius_to_edge = 2.2;
// Angles between faces that are wanted one after the other; how many questions may be asked for each.
inline constexpr std::array sliver_degrees = {1.0, 2.0, 4.0, 8.0, 12.0};
inline constexpr uint64_t questions_to_mend = 500'000, questions_to_mend_of_cell = 100;
// How near to the surface its points lie, as a share of the size.
inline constexpr double surface_error = 1e-4;

// Counts what the mesher asks, and stops it by Enough where it asks more than is allowed.
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

// Puts points and tetrahedra in the order in which Tetrahedra has them.
void put_in_order(Tetrahedra& made);

// The tetrahedra of a request that is periodic. Throws Error and Questions::Enough.
Tetrahedra make_periodic(const TetrahedraRequest& request);

}  // namespace ombre::solids
