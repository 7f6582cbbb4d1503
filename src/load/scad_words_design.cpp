#include "load/scad_words_design.h"

#include "base/system/tasks.h"
#include "lang/vcad/scad_words.h"
#include "load/design_sources.h"
#include "load/load.h"
#include "nodes/all_nodes.h"

namespace ombre::compile {
WordsRun run_with_words(const SourcePtr& script, lang::openscad::Options run, const LoadOptions& options,
                        lang::openscad::Messages& messages, Diagnostics& diagnostics) {
  sources::SourceCache own;
  sources::SourceCache& cache = options.cache ? *options.cache : own;
  const auto materials = load_materials(options.materials, diagnostics);
  if (!materials) return {};
  DesignSources loader(cache, options.stop, options.threads > 0 ? options.threads : core_count());
  lang::ScadWords words(nodes::registry(), *materials, &loader, script->name());
  run.words = &words;
  WordsRun result;
  result.outcome = lang::openscad::run_with_files(script, run, messages);
  if (result.outcome.tree && messages.error_count() == 0)
    result.design = words.finish(result.outcome.tree, {script, 0, 0}, diagnostics);
  return result;
}

}  // namespace ombre::compile
