// Finds the points where edges of a block of cells cross from one region into another.
#pragma once

#include <span>
#include <vector>

#include "surface/cells/point_evaluator.h"

namespace ombre::surface {

// The search on one edge: start + t * along, with t from 0 to 1. `t` is the crossing once the search has finished.
struct EdgeSearch {
  Vec3 start, along;
  Label from = 0, to = 0;
  double t = -1;            // -1 until found
  bool is_between = false;  // true if `start` lies in region `from` and the other end in region `to`
  // True if a continuous value separates the regions along the edge; `rise` is its increase from start to end.
  bool by_value = false;
  double rise = 0;

  // Bounds of the crossing; f_lo and f_hi are the values there if by_value.
  double lo = 0, hi = 1, f_lo = 0, f_hi = 0;
  int last_kept = 0;
  bool is_done = false;

  Vec3 point(double s) const { return start + s * along; }
};

// Finds the crossings. If a continuous value (a distance, a fraction) separates the regions, its zero is found by the
// secant method, Illinois variant; otherwise by bisection on the labels.
void search_edges(std::span<EdgeSearch> searches, PointEvaluator& evaluator);

}  // namespace ombre::surface
