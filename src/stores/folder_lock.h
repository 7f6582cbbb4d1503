// Keeps two runs from writing into one folder, or into one journal.
#pragma once

#include <string>

#include "base/system/not_copied.h"

namespace ombre::stores {

// A lock of a folder that is held until the object is destroyed, or the program ends in any way.
class FolderLock : NotCopied {
 public:
  // Runs that share a folder exclude only one that wants it alone.
  enum class Kind { alone, shared };

  // Throws Error when another run holds it or the folder cannot be opened.
  explicit FolderLock(const std::string& folder, Kind kind = Kind::alone);
  ~FolderLock();

 private:
  int descriptor_ = -1;
};

// A lock that is a file, which is removed when the lock ends. A file that a killed program leaves locks nothing.
class FileLock : NotCopied {
 public:
  // Throws Error when another run holds it or the file cannot be made.
  explicit FileLock(std::string path);
  ~FileLock();

 private:
  bool is_current() const;

  std::string path_;
  int descriptor_ = -1;
};

}  // namespace ombre::stores
