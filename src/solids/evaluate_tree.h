// From a tree of geometry to its pieces.
#pragma once

#include <functional>

#include "base/system/progress.h"
#include "base/text/diagnostic.h"
#include "solids/solid.h"

namespace ombre::solids {

struct EvaluateOptions {
  int threads = 0;           // 0: all cores
  bool keeps_empty = false;  // solids of nothing keep the attributes that are set on them
  const StopFlag* stop = nullptr;
  Progress* progress = nullptr;  // in operations
};

// In the order of the script, without empty ones. Equal subtrees are computed once, independent ones at the same time.
// Pieces and messages do not depend on the number of threads.
//
// Groups, transforms and attributes unite what has the same material, part and colour; other operations work on what
// has the same material and part, and give it the colour of the first. A difference subtracts all that follows its
// first child from each piece of that, whatever their attributes. `Semantics::strict` tells colours apart in all
// operations, and subtracts only what matches; `permissive` takes each child as one solid.
//
// What is wrong is reported in `messages` with the place of the call, and left out. Throws Error when this was built
// without the libraries, and Cancelled.
Pieces evaluate(const TreePtr& tree, const EvaluateOptions& options, Diagnostics& messages);

}  // namespace ombre::solids
