// Evaluates a tree of geometry to its pieces.
#pragma once

#include <functional>

#include "base/system/progress.h"
#include "base/text/diagnostic.h"
#include "solids/solid.h"

namespace ombre::solids {

struct EvaluateOptions {
  int threads = 0;           // 0: all cores
  bool keeps_empty = false;  // empty solids keep the attributes that are set on them
  const StopFlag* stop = nullptr;
  Progress* progress = nullptr;  // in operations
};

// Returns the pieces in the order of the script, without empty ones. Equal subtrees are computed once, independent ones
// in parallel. Pieces and messages do not depend on the number of threads.
//
// Groups, transforms and attributes unite pieces with the same material, part and colour. Other operations work on
// pieces with the same material and part, and give the result the colour of the first. A difference subtracts all
// children after the first from each piece of the first, whatever their attributes. `Semantics::strict` also
// distinguishes colours in all operations, and subtracts only pieces that match; `permissive` treats each child as one
// solid.
//
// Errors are reported in `messages` with the place of the call, and the geometry concerned is left out. Throws Error if
// this build lacks the libraries, and Cancelled.
Pieces evaluate(const TreePtr& tree, const EvaluateOptions& options, Diagnostics& messages);

}  // namespace ombre::solids
