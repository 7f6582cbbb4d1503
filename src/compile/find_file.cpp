#include "compile/find_file.h"

#include <filesystem>

namespace ombre::compile {

namespace fs = std::filesystem;

std::optional<std::string> find_file(const std::string& path, const SourceRange& where, Diagnostics& diagnostics) {
  std::error_code ignored;
  const fs::path wanted(path);
  const fs::path script = where.source ? fs::path(where.source->name()) : fs::path();
  const fs::path beside = wanted.is_absolute() ? wanted : script.parent_path() / wanted;
  if (fs::exists(beside, ignored)) return beside.string();
  if (fs::exists(wanted, ignored)) return path;
  std::string looked = beside.string();
  if (beside != wanted && !wanted.is_absolute())
    looked += " and " + fs::absolute(wanted, ignored).lexically_normal().string();
  diagnostics.error(where, "there is no file \"" + path + "\"", "looked for " + looked);
  return std::nullopt;
}

}  // namespace ombre::compile
