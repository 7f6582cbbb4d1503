// Runs a script: reads text and returns nodes of a vocabulary.
#pragma once

#include <vector>

#include "lang/engine/run_options.h"
#include "lang/engine/vocabulary.h"

namespace ombre::lang {

// Parses and evaluates a script, and returns its top-level nodes in order. Errors become diagnostics. Code that does
// not depend on them is still evaluated, so that one run finds several.
std::vector<Product> run(const SourcePtr& source, Vocabulary& vocabulary, const Options& options,
                         Diagnostics& diagnostics);

}  // namespace ombre::lang
