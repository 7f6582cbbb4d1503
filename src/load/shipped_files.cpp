#include "load/shipped_files.h"

#include <algorithm>

#include "base/system/named_files.h"
#include "base/text/error.h"
#include "base/text/text.h"

namespace ombre::compile {

namespace fs = std::filesystem;

bool is_path(const std::string& text) { return text.ends_with(".json") || text.find('/') != std::string::npos; }

std::vector<std::string> ShippedFiles::names() const {
  std::vector<std::string> names;
  for (const fs::path& folder : folders)
    for (const std::string& name : names_in(folder.string()))
      if (const fs::path file(name); file.extension() == ".json") names.push_back(file.stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<std::string> ShippedFiles::find(const std::string& name_or_path, Diagnostics& diagnostics) const {
  if (is_path(name_or_path)) return name_or_path;
  const std::vector<std::string> known = names();
  const std::string wanted = fold_name(name_or_path);
  for (const std::string& name : known)
    for (const fs::path& folder : folders)
      if (const fs::path path = folder / (name + ".json"); fold_name(name) == wanted && fs::exists(path))
        return path.string();

  std::string hint = did_you_mean(name_or_path, known);
  hint += (hint.empty() ? "" : " ") + std::string("there are ") + join(known, ", ") + "; or give the path of a .json " +
          file;
  diagnostics.error(unknown, {}, "there is no " + noun + " \"" + name_or_path + '"', std::move(hint),
                    {{key, name_or_path}});
  return std::nullopt;
}

}  // namespace ombre::compile
