// Reads the files of a job from its folder, or from the archive that it became.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace ombre::stores {

// Thread-safe.
class StoredFiles {
 public:
  virtual ~StoredFiles() = default;

  // Returns the names, sorted.
  virtual const std::vector<std::string>& names() const = 0;
  // Throws Error.
  virtual std::string read(const std::string& name) const = 0;
};
using StoredFilesPtr = std::shared_ptr<const StoredFiles>;

// Throws Error if the path is neither a folder nor an archive that can be read.
StoredFilesPtr open_files(const std::string& path);

}  // namespace ombre::stores
