// Runs an OpenSCAD script: reads text and returns a tree of solids.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lang/openscad/script_messages.h"
#include "lang/openscad/script_options.h"
#include "solids/tree.h"

namespace ombre::lang::openscad {

// Returns the group of all top-level nodes, or the node marked "!". Returns null if the script could not be read or
// stopped at an error. The script's messages are added to `messages`. Paths in the tree are complete.
solids::TreePtr run(const SourcePtr& source, const Options& options, Messages& messages);

// True if the script, or a file that it includes or uses, contains `use <ombre>`.
bool uses_words(const SourcePtr& source, const Options& options);

// Returns the script's statements as OpenSCAD prints them (`-o file.ast`), or nothing if it cannot be read.
std::optional<std::string> syntax_tree(const SourcePtr& source, const Options& options, Messages& messages);

// The tree of a script, and its files: the script itself, the files that it includes and uses, and those that its tree
// imports.
struct Outcome {
  solids::TreePtr tree;
  std::vector<std::string> files;
};
Outcome run_with_files(const SourcePtr& source, const Options& options, Messages& messages);

// Returns the folders of libraries: those of the environment variable OPENSCADPATH, the user's, and those of an
// installed OpenSCAD.
std::vector<std::string> library_folders();

}  // namespace ombre::lang::openscad
