// Keeps two runs from writing into one folder.
#pragma once

#include <string>

namespace ombre::compile {

// A lock of a folder that is held until the object is destroyed, or the program ends in any way.
class FolderLock {
 public:
  // Throws Error when another run holds it or the folder cannot be opened.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace ombre::compile
