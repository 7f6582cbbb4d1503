// Loads designs, and notes what the statements of scripts make.
#pragma once

#include <functional>
#include <vector>

#include "load/loaded.h"

namespace ombre::compile {

// Is told the solids that a statement of a .vcad script has made, each time that it has run.
using NoteSolids = std::function<void(const SourceRange& statement, std::vector<design::NodePtr> solids)>;

// Loads a design as load_text does (load.h).
LoadedPtr load_noting(std::string text, const std::string& path, const LoadOptions& options, const NoteSolids& note,
                      Diagnostics& diagnostics);

}  // namespace ombre::compile
