#include "load/files_read.h"

#include "base/system/named_files.h"
#include "load/load.h"

namespace ombre::compile {

namespace fs = std::filesystem;

std::optional<std::set<fs::path>> files_read(const std::string& path, const LoadOptions& options,
                                             Diagnostics& diagnostics) {
  sources::SourceCache cache;
  LoadOptions own = options;
  own.cache = &cache;
  if (!load_design(path, own, diagnostics)) return std::nullopt;
  std::set<fs::path> files;
  for (const std::string& file : cache.files().paths()) files.insert(whole_path(file));
  return files;
}

}  // namespace ombre::compile
