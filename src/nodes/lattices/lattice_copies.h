// Copies at equal steps along perpendicular directions, and the choice of those that matter at a point.
#pragma once

#include <array>
#include <vector>

#include "base/math/box.h"
#include "program/field.h"

namespace ombre::nodes {

// Copies (i, j, k) translated by i, j and k steps. At each point only a few copies around it are evaluated, regardless
// of their total number.
class LatticeCopies {
 public:
  struct Row {
    Vec3 step;  // along an axis of the frame, in either direction
    int count = 1;
  };

  LatticeCopies() = default;
  // `frame_from_here` must be a rotation. `bounds` encloses the original.
  LatticeCopies(const Affine& frame_from_here, const std::array<Row, 3>& rows, const Box& bounds);

  // Returns the points at which the copies that may hold p are evaluated, in the order of the copies.
  std::vector<program::Point> holding(const program::Point& p) const;
  // Returns the points for the copies that may be nearest to p, in the same order. This holds for points between the
  // outermost copies.
  std::vector<program::Point> around(const program::Point& p) const;
  // Returns the number of points that `around` returns.
  double around_count() const;
  bool queries_all() const;
  // Returns a lower bound of the distance to all other copies. There must be such copies.
  program::Field distance_of_others(const program::Point& p) const;
  // Returns the signed distance from the box around the original.
  program::Field distance_of_box(const program::Point& p) const;

  // A part of the original. It is used to enclose copies of the part of the original that is found within `originals`.
  struct Part {
    Box originals;  // empty if no copy reaches
    Vec3 least, greatest;
  };
  // Returns the points of the original that are evaluated for the points of `where`, if they lie within the box
  // `reachable`.
  Part part(const Box& where, const Box& reachable) const;
  const Box& original() const { return original_; }  // the bounds given to the constructor
  // Returns a box around the points at which distance_of_others is at most `margin`.
  Box others(double margin) const;

 private:
  struct Window {
    std::array<int, 3> counts{1, 1, 1};
    double reach_mm = 0;
  };
  Window window(double reach_mm) const;
  Interval in_steps(size_t axis, Interval mm) const;
  std::vector<program::Point> candidates(const program::Point& p, const Window& window) const;
  bool has_all(const Window& window) const;
  Box hull() const;

  Affine frame_from_here_;
  std::array<Row, 3> rows_;
  std::array<double, 3> steps_{};  // along the frame's axes
  Box original_, box_;             // bounds of the original in this space, and in the frame
  Window holding_, around_;
};

}  // namespace ombre::nodes
