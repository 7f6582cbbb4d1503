// Applies one operation of a tree to the results of its children.
#pragma once

#include "base/text/diagnostic.h"
#include "solids/booleans.h"
#include "solids/solid.h"

namespace ombre::solids {

struct OperationContext {
  Work work;
  bool keeps_empty = false;
  Diagnostics* messages = nullptr;
};

// Returns the result of an operation: at least one piece, which may be empty. `children` leaves out those in the
// background (%), and has no pieces for a child without a result.
Pieces apply(const Tree& tree, const std::vector<const Pieces*>& children, const OperationContext& context);

// Returns the geometry of a leaf.
Pieces leaf_pieces(const Tree& tree, const OperationContext& context);
bool is_leaf(const Operation& operation);

}  // namespace ombre::solids
