#include "jobs/common/memory_loader.h"

#include "load/load.h"

namespace ombre::jobs {

DesignLoader memory_loader(compile::LoadedPtr design, bool is_file) {
  return [design = std::move(design), is_file](const std::string& path, const compile::LoadOptions& options,
                                               Diagnostics& diagnostics) -> compile::LoadedPtr {
    const bool is_as_made = options.definitions.empty() && options.needed.empty() && options.materials.empty() &&
                            options.material_map.empty();
    if (is_as_made) return design;
    if (is_file) return compile::load_design(path, options, diagnostics);
    diagnostics.error(Code::option, {design->source, 0, 0},
                      "a design in memory has neither variables that a job could set nor a materials file",
                      "run the job on the script, by its path");
    return nullptr;
  };
}

}  // namespace ombre::jobs
