// Copies turned about an axis in equal steps: where they lie, and which of them a point has to ask.
#pragma once

#include <vector>

#include "base/math/box.h"
#include "program/field.h"

namespace ombre::nodes {

class TurnedCopies {
 public:
  TurnedCopies() = default;
  // `turn_from_original` takes the original to a frame whose z axis is the axis that copies are turned about.
  // `degrees` lie between two copies; with `is_full` the last one is followed by the first.
  TurnedCopies(const Affine& turn_from_here, const Affine& turn_from_original, int count, double degrees, bool is_full,
               const Box& bounds);

  // Where the copies that may hold the point are evaluated. In order, the first one first, only if `is_in_order`.
  std::vector<program::Point> holding(const program::Point& p) const;
  bool is_in_order() const { return candidates_ == count_ || !is_full_; }
  // Where all are evaluated, in order.
  std::vector<program::Point> all(const program::Point& p) const;

  // Encloses the points of the original that the points of `where` may ask.
  Box originals(const Box& where) const;
  // Encloses what the copies make of the part of the original that lies within `reached`.
  Box copies(const Box& reached, const Box& where) const;

 private:
  void find_sector(const Box& bounds);
  Affine place(int copy) const;  // takes the original to its copy

  Affine turn_from_here_, turn_from_original_;
  int count_ = 1;
  double degrees_ = 0;
  bool is_full_ = false;
  // The original lies within this angle, to both sides of the middle.
  double middle_degrees_ = 0, half_degrees_ = 180;
  int candidates_ = 1;
};

}  // namespace ombre::nodes
