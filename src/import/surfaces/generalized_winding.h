// Decides what is inside of a surface with gaps: points with a winding number of more than one half.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/math/box.h"
#include "import/surfaces/cap_winding.h"
#include "import/surfaces/capped_surface.h"
#include "import/surfaces/point_winding.h"

namespace ombre::importing {

// The generalized winding number (Jacobson, Kavan and Sorkine-Hornung, "Robust inside-outside segmentation using
// generalized winding numbers", 2013). It is the integer winding number of the surface closed by caps, minus that of
// the caps. Away from gaps the caps contribute less than one half, so the integer alone decides. An octree separates
// those places from the others, where the difference has to be computed.
class GeneralizedWinding {
 public:
  explicit GeneralizedWinding(const Surface& surface);

  // The rule that decides at a place.
  enum class Rule : uint8_t { closed, inside, outside, difference };

  // Returns the surface with its caps.
  const SurfacePtr& closed() const { return closed_; }

  // A part of space with one rule.
  struct Place {
    Rule rule = Rule::closed;
    uint32_t first_cap = 0, caps = 0;  // the caps that a difference has to sum
  };

  bool contains(Vec3 p) const;
  const Place& place_at(Vec3 p) const;
  // Decides for points of a place whose rule is the difference; `whole` is the winding number of the closed surface at
  // them.
  void decide(const Place& place, std::span<const Vec3> points, int64_t whole, std::span<char> inside) const;

  // Calls visit(begin, end, place) for pieces of the row of points origin + i * step, i from `begin` to `end`, in
  // ascending order. Points that no piece contains lie outside of the surface's bounds.
  template <class Visit>
  void pieces(Vec3 origin, Vec3 step, int64_t begin, int64_t end, const Visit& visit) const {
    const RowPiece row = within_bounds(origin, step, begin, end);
    if (row.begin < row.end) pieces(0, box_, row, visit);
  }

 private:
  struct Node {
    uint32_t first_child = 0;  // index of the first of eight children, x varying fastest; 0 in a leaf
    Place place;
  };
  struct RowPiece {
    Vec3 origin, step;
    int64_t begin, end;
    Vec3 at(int64_t i) const { return origin + static_cast<double>(i) * step; }
    RowPiece between(int64_t from, int64_t to) const { return {origin, step, from, to}; }
    // Returns the first point from `begin` on that lies beyond a plane: at `value` or above if the row rises along the
    // axis, below it if the row falls; `end` if there is none.
    int64_t first_beyond(int axis, double value) const;
  };
  struct Growth;

  GeneralizedWinding(const Surface& surface, CappedSurface capped);

  void grow(const Surface& surface);
  std::optional<Rule> settled(const Growth& growth) const;
  void leave_open(const Growth& growth);
  void split(const Surface& surface, const Growth& growth, std::vector<Growth>& next);
  RowPiece within_bounds(Vec3 origin, Vec3 step, int64_t begin, int64_t end) const;
  static Box child_box(const Box& box, unsigned child);
  // Returns the octant of a box that contains a point; the middle planes belong to the upper octants.
  static unsigned child_at(const Box& box, Vec3 p);

  template <class Visit>
  void pieces(uint32_t index, const Box& box, const RowPiece& row, const Visit& visit) const {
    const Node& node = nodes_[index];
    if (node.first_child == 0) {
      visit(row.begin, row.end, node.place);
      return;
    }
    const Vec3 center = box.center();
    std::array<int64_t, 5> cuts{row.begin, row.first_beyond(0, center.x), row.first_beyond(1, center.y),
                                row.first_beyond(2, center.z), row.end};
    std::sort(cuts.begin(), cuts.end());
    for (size_t n = 0; n + 1 < cuts.size(); ++n) {
      if (cuts[n] >= cuts[n + 1]) continue;
      const unsigned child = child_at(box, row.at(cuts[n]));
      pieces(node.first_child + child, child_box(box, child), row.between(cuts[n], cuts[n + 1]), visit);
    }
  }

  Box box_;
  SurfacePtr closed_;
  CapWinding caps_;
  PointWinding whole_;
  std::vector<Node> nodes_;
  std::vector<uint32_t> place_caps_;
};

}  // namespace ombre::importing
