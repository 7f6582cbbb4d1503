// Finds data files that come with Ombre, such as printer profiles, by name or by path.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"

namespace ombre::compile {

// True if the text is a path, not a name: it ends in ".json" or holds a '/'.
bool is_path(const std::string& text);

// Files NAME.json in folders.
struct ShippedFiles {
  std::vector<std::filesystem::path> folders;
  std::string noun;  // what a name stands for: "printer"
  std::string file;  // what a path leads to: "profile"
  Code unknown;      // the code of an unknown name
  std::string key;   // the name of the code's value

  // Returns the sorted names. Throws Error if a folder cannot be read.
  std::vector<std::string> names() const;
  // Looks a name up; a path stays one. Returns nothing, and adds a diagnostic, for an unknown name.
  std::optional<std::string> find(const std::string& name_or_path, Diagnostics& diagnostics) const;
};

}  // namespace ombre::compile
