// Finds where the edges of a block of cells cross from one region into the next.
#pragma once

#include <span>
#include <vector>

#include "surface/cells/point_evaluator.h"

namespace ombre::surface {

// One edge: start + t * along, t from 0 to 1. Its crossing is at `t` when the search is over.
struct EdgeSearch {
  Vec3 start, along;
  Label from = 0, to = 0;
  double t = -1;            // none yet
  bool is_between = false;  // `start` lies in region `from`, the other end in region `to`
  // Whether the value that parts the regions goes through zero on the edge, and by how much it rises along it.
  bool by_value = false;
  double rise = 0;

  // The crossing lies between them; f at both, where by_value.
  double lo = 0, hi = 1, f_lo = 0, f_hi = 0;
  int last_kept = 0;
  bool is_done = false;

  Vec3 point(double s) const { return start + s * along; }
};

// By what goes through zero there (a distance, a fraction) with the secant method, Illinois variant; where there is
// no such value, by halving between the regions.
void search_edges(std::span<EdgeSearch> searches, PointEvaluator& evaluator);

}  // namespace ombre::surface
