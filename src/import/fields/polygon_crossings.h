// Crossings of parallel lines with the edges of polygons.
#pragma once

#include <optional>
#include <vector>

#include "base/math/polygons.h"
#include "import/fields/dyadic_bins.h"
#include "import/fields/ray_crossings.h"

namespace ombre::importing {

// Winding numbers around a point: of the solid's rings and of the holes.
struct PolygonWinding {
  int solid = 0, holes = 0;
  bool is_inside() const { return solid != 0 && holes == 0; }
};

// Crossings along lines parallel to `step`; positions along a line are measured in steps.
class PolygonCrossings {
 public:
  // Constructs the crossings; `step` must not be zero.
  PolygonCrossings(const Polygons& polygons, Vec2 step);

  // line_of() returns the line through a point, place_of() the point's position along it.
  double line_of(Vec2 p) const { return cross(step_, p); }
  double place_of(Vec2 p) const { return dot(step_, p) / dot(step_, step_); }

  // Calls visit(place, winding, is_hole) for each edge that the line crosses, in no particular order. Beyond that
  // place, the winding number is greater by `winding`. All of them add up to zero.
  template <class Visit>
  void at(double line, const Visit& visit) const {
    bins_->at(line, 0, [&](uint32_t id) {
      const Edge& edge = edges_[id];
      const int change = winding(edge.placed, line);
      if (change != 0) visit(cross_row(edge.placed, line), change, edge.is_hole);
    });
  }

  PolygonWinding winding_at(Vec2 p) const;

 private:
  struct Edge {
    Segment placed;  // x is the place along a line, y the line
    bool is_hole;
  };
  void add(const std::vector<Ring>& rings, bool are_holes);

  Vec2 step_;
  std::vector<Edge> edges_;
  std::optional<DyadicBins> bins_;  // sorted by line
};

}  // namespace ombre::importing
