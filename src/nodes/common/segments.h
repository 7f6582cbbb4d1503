// Straight pieces from one point to another: the axes of struts.
#pragma once

#include "base/math/box.h"
#include "program/field.h"

namespace ombre::nodes {

struct Segment {
  Vec3 start, end;  // mm

  // Where the nearest point lies, from 0 at the start to 1 at the end.
  program::Field along(const program::Point& p) const;
  program::Field squared_distance(const program::Point& p) const;
};

// Encloses the points of `where` whose nearest point on the segment is not farther than the margins along each axis.
Box reach_of_segment(Vec3 start, Vec3 end, Vec3 margins, const Box& where);

}  // namespace ombre::nodes
