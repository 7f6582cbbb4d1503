// Makes CGAL's box intersection independent of memory addresses.
//
// Where boxes begin at the same coordinate, CGAL's algorithm orders them by their ids. Corefinement uses addresses as
// ids, so the order in which it finds crossings, and with it the triangles of a result, depended on the allocator. Here
// ids count the boxes in the order of their construction. Include this before other headers of CGAL.
#pragma once

#include <CGAL/Box_intersection_d/Box_d.h>

namespace CGAL::Box_intersection_d {

template <>
class Box_d<double, 3, ID_FROM_BOX_ADDRESS> : public Box_d<double, 3, ID_EXPLICIT> {
 public:
  using Box_d<double, 3, ID_EXPLICIT>::Box_d;
};

}  // namespace CGAL::Box_intersection_d
