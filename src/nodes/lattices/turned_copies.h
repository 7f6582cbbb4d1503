// Copies rotated about an axis in equal steps, and the choice of those that matter at a point.
#pragma once

#include <vector>

#include "base/math/box.h"
#include "program/field.h"

namespace ombre::nodes {

class TurnedCopies {
 public:
  TurnedCopies() = default;
  // `turn_from_original` maps the original to a frame whose z axis is the axis of rotation. `degrees` is the angle
  // between two copies. With `is_full` the last copy is followed by the first.
  TurnedCopies(const Affine& turn_from_here, const Affine& turn_from_original, int count, double degrees, bool is_full,
               const Box& bounds);

  // Returns the points at which the copies that may hold p are evaluated. They are in the order of the copies only if
  // `is_in_order`.
  std::vector<program::Point> holding(const program::Point& p) const;
  bool is_in_order() const { return candidates_ == count_ || !is_full_; }
  // Returns the points for all copies, in order.
  std::vector<program::Point> all(const program::Point& p) const;

  // Returns a box around the points of the original that are evaluated for the points of `where`.
  Box originals(const Box& where) const;
  // Returns a box around the copies of the part of the original that lies within `reached`.
  Box copies(const Box& reached, const Box& where) const;

 private:
  void find_sector(const Box& bounds);
  Affine place(int copy) const;  // maps the original to its copy

  Affine turn_from_here_, turn_from_original_;
  int count_ = 1;
  double degrees_ = 0;
  bool is_full_ = false;
  // The original lies within `half_degrees_` on both sides of `middle_degrees_`.
  double middle_degrees_ = 0, half_degrees_ = 180;
  int candidates_ = 1;
};

}  // namespace ombre::nodes
