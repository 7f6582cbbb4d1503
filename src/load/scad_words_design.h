// Runs OpenSCAD scripts that say `use <ombre>`, as designs.
#pragma once

#include <optional>

#include "design/design.h"
#include "lang/openscad/run_script.h"
#include "load/loaded.h"

namespace ombre::compile {

struct WordsRun {
  lang::openscad::Outcome outcome;       // has no tree after an error
  std::optional<design::Design> design;  // nothing, with a message or a diagnostic, when the script makes no solid
};

// Runs the script with Ombre's words. Definitions are those of `run`; the rest of `options` gives the materials and the
// places of files. The script's output goes to `messages`.
WordsRun run_with_words(const SourcePtr& script, lang::openscad::Options run, const LoadOptions& options,
                        lang::openscad::Messages& messages, Diagnostics& diagnostics);

}  // namespace ombre::compile
