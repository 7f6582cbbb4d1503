// Box intersections of CGAL in an order that no memory address decides.
//
// Where boxes begin at one coordinate, CGAL's algorithm goes by their ids. Corefinement takes the boxes' addresses for
// these, so that the order in which it finds crossings, and with it the triangles of a result, depended on where the
// heap had room. Here ids count the boxes as they are made. To be included before other headers of CGAL.
#pragma once

#include <CGAL/Box_intersection_d/Box_d.h>

namespace CGAL::Box_intersection_d {

template <>
class Box_d<double, 3, ID_FROM_BOX_ADDRESS> : public Box_d<double, 3, ID_EXPLICIT> {
 public:
  using Box_d<double, 3, ID_EXPLICIT>::Box_d;
};

}  // namespace CGAL::Box_intersection_d
