// Loads designs, and notes what the statements and expressions of scripts make.
#pragma once

#include <functional>
#include <vector>

#include "load/loaded.h"

namespace ombre::compile {

// Functions that are told what a .vcad script makes; either may be empty.
struct ScriptNotes {
  // The solids that a statement has made, each time that it has run.
  std::function<void(const SourceRange& statement, std::vector<design::NodePtr> solids)> solids;
  // A value that a call in an expression or a variable had when it was computed first, as data of a parameter. Of an
  // operator with several outputs it is the first one that varies in space.
  std::function<void(const SourceRange& expression, Data value)> value;
};

// Loads a design as load_text does (load.h).
LoadedPtr load_noting(std::string text, const std::string& path, const LoadOptions& options, const ScriptNotes& notes,
                      Diagnostics& diagnostics);

}  // namespace ombre::compile
