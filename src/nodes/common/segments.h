// Line segments, which are the axes of struts.
#pragma once

#include "base/math/box.h"
#include "program/field.h"

namespace ombre::nodes {

struct Segment {
  Vec3 start, end;  // end points in mm

  // Returns the position of the nearest point, from 0 at the start to 1 at the end.
  program::Field along(const program::Point& p) const;
  program::Field squared_distance(const program::Point& p) const;
};

// Returns a box around the points of `where` whose nearest point on the segment is within the margin along each axis.
Box reach_of_segment(Vec3 start, Vec3 end, Vec3 margins, const Box& where);

}  // namespace ombre::nodes
