// Runs an OpenSCAD script: text in, a tree of solids out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lang/openscad/script_messages.h"
#include "lang/openscad/script_options.h"
#include "solids/tree.h"

namespace ombre::lang::openscad {

// The group of all top-level nodes, or what "!" marks; null where the script could not be read or stopped at an error.
// What the script says goes to `messages`. Paths in the tree are complete.
solids::TreePtr run(const SourcePtr& source, const Options& options, Messages& messages);

// Whether the script, or a file that it brings in, says `use <ombre>`.
bool uses_words(const SourcePtr& source, const Options& options);

// The script's statements as OpenSCAD prints them (`-o file.ast`); nothing where it cannot be read.
std::optional<std::string> syntax_tree(const SourcePtr& source, const Options& options, Messages& messages);

// The files that the script includes and uses, itself first, and those that its tree imports.
struct Outcome {
  solids::TreePtr tree;
  std::vector<std::string> files;
};
Outcome run_with_files(const SourcePtr& source, const Options& options, Messages& messages);

// Folders of libraries: those of the environment variable OPENSCADPATH, the user's, and those of an installed OpenSCAD.
std::vector<std::string> library_folders();

}  // namespace ombre::lang::openscad
