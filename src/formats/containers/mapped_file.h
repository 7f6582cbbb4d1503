// Files mapped into memory, which the system reads and evicts on demand.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/system/not_copied.h"

namespace ombre::formats {

// The bytes of a mapped file. The file must not change during the lifetime of this object.
class MappedFile : NotCopied {
 public:
  // Maps a file. Throws Error, naming the path and the reason.
  explicit MappedFile(const std::string& path);
  ~MappedFile();

  std::string_view bytes() const { return {static_cast<const char*>(begin_), size_}; }

 private:
  void* begin_ = nullptr;
  size_t size_ = 0;
};

}  // namespace ombre::formats
