// Copies at equal steps along directions at right angles: which of them a point has to ask.
#pragma once

#include <array>
#include <vector>

#include "base/math/box.h"
#include "program/field.h"

namespace ombre::nodes {

// Copy (i, j, k) is moved by i, j and k steps. A point asks a few copies around it, however many there are.
class LatticeCopies {
 public:
  struct Row {
    Vec3 step;  // along an axis of the frame, one way or the other
    int count = 1;
  };

  LatticeCopies() = default;
  // `frame_from_here` is a rotation; `bounds` encloses what is copied.
  LatticeCopies(const Affine& frame_from_here, const std::array<Row, 3>& rows, const Box& bounds);

  // Where the copies that may hold the point are evaluated, the first ones first.
  std::vector<program::Point> holding(const program::Point& p) const;
  // The same of those within a reach beyond which no copy can be the nearest, as long as the point lies between the
  // outermost ones.
  std::vector<program::Point> around(const program::Point& p) const;
  // How many points `around` gives.
  double around_count() const;
  bool queries_all() const;
  // What the distance to all other copies is at least; only if there are others.
  program::Field distance_of_others(const program::Point& p) const;
  // The signed distance from the box around the original.
  program::Field distance_of_box(const program::Point& p) const;

  // Encloses copies of the box `reached` of the original, found within `originals`.
  struct Part {
    Box originals;  // empty: no copy reaches
    Vec3 least, greatest;
  };
  // Which points of the original the points of `where` evaluate, if these lie within the box `reachable`.
  Part part(const Box& where, const Box& reachable) const;
  const Box& original() const { return original_; }  // the bounds that were given
  // Encloses the points at which distance_of_others is `margin` or less.
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
  Box original_, box_;             // here, and in the frame
  Window holding_, around_;
};

}  // namespace ombre::nodes
