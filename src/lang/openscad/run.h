// Runs an OpenSCAD script: text in, a tree of solids out.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/progress.h"
#include "lang/limits.h"
#include "lang/openscad/messages.h"
#include "lang/openscad/words.h"
#include "solids/tree.h"

namespace ombre::lang::openscad {

// The view in which `$vpr`, `$vpt`, `$vpd` and `$vpf` are what scripts read: degrees, mm, mm, degrees.
struct View {
  std::array<double, 3> rotation{0, 0, 0}, target{0, 0, 0};
  double distance = 500, field = 22.5;
};

struct Options {
  // `-D name=expression`; each takes the place of the top-level variable of that name. The text is read as script.
  std::vector<std::string> definitions;
  // Folders where `include` and `use` look after the folder of the file that asks.
  std::vector<std::string> libraries;
  Limits limits = openscad_limits();
  const StopFlag* stop = nullptr;  // checked now and then; Cancelled is thrown
  // What `include` and `use` read: nothing where there is no such file. Empty for the real files.
  std::function<std::optional<std::string>(const std::string& path)> read_file;
  View view;
  double time = 0;                 // $t
  bool is_preview = true;          // $preview: true, as OpenSCAD has it without `--render`
  bool stops_at_warnings = false;  // --hardwarnings
  Words* words = nullptr;          // what `use <ombre>` brings; null: there `use <ombre>` is an error

  // Scripts may call functions inside each other some 10,000 times; the evaluation has a stack of its own for that.
  static Limits openscad_limits();
};

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
