#include "sources/find_file.h"

#include <filesystem>

#include "base/system/named_files.h"
#include "base/text/text.h"

namespace ombre::sources {

namespace fs = std::filesystem;

std::optional<std::string> find_file(const std::string& path, const SourceRange& where, Diagnostics& diagnostics) {
  std::error_code ignored;
  std::vector<std::string> places = places_of(path, where.source ? where.source->name() : "");
  for (const std::string& place : places)
    if (fs::exists(place, ignored)) return place;
  if (places.size() > 1) places.back() = fs::absolute(path, ignored).lexically_normal().string();
  diagnostics.error(Code::file_missing, where, "there is no file \"" + path + "\"",
                    "looked for " + join(places, " and "), {{"file", path}});
  return std::nullopt;
}

}  // namespace ombre::sources
