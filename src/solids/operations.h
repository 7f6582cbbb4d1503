// One operation of a tree, on what its children gave.
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

// `children` are without those of the background; one that gave nothing has no pieces. At least one piece, which may be
// empty.
Pieces apply(const Tree& tree, const std::vector<const Pieces*>& children, const OperationContext& context);

// The geometry of a leaf.
Pieces leaf_pieces(const Tree& tree, const OperationContext& context);
bool is_leaf(const Operation& operation);

}  // namespace ombre::solids
