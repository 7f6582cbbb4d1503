// Runs a script: text in, nodes of a vocabulary out.
#pragma once

#include <vector>

#include "lang/engine/run_options.h"
#include "lang/engine/vocabulary.h"

namespace ombre::lang {

// Parses and evaluates; the top-level nodes in order. Mistakes become diagnostics, and what was
// not affected by them is still evaluated, so that one run finds several.
std::vector<Product> run(const SourcePtr& source, Vocabulary& vocabulary, const Options& options,
                         Diagnostics& diagnostics);

}  // namespace ombre::lang
