// A new folder for files that other programs or modules read. It is deleted with its content.
#pragma once

#include <filesystem>
#include <string>

#include "base/system/not_copied.h"

namespace ombre {

class TemporaryFolder : NotCopied {
 public:
  // Creates the folder in the system's folder for temporary files. Throws Error if this fails.
  TemporaryFolder();
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace ombre
