// OpenSCAD scripts that say `use <ombre>`, as designs.
#pragma once

#include <optional>

#include "design/design.h"
#include "lang/openscad/run_script.h"
#include "load/loaded.h"

namespace ombre::compile {

struct WordsRun {
  lang::openscad::Outcome outcome;       // without a tree after an error
  std::optional<design::Design> design;  // nothing, and a message or a diagnostic, when the script makes none
};

// Runs the script with Ombre's words. Definitions are those of `run`; the rest of `options` says which materials there
// are, and where files come from. What the script says goes to `messages`.
WordsRun run_with_words(const SourcePtr& script, lang::openscad::Options run, const LoadOptions& options,
                        lang::openscad::Messages& messages, Diagnostics& diagnostics);

}  // namespace ombre::compile
