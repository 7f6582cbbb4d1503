// Files that the system reads where they are used, and lets go of where they are not.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ombre::formats {

// The bytes of a file as a part of memory that takes no room. The file must not change as long as this lives.
class MappedFile {
 public:
  // Throws Error, naming the path and the reason.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return {static_cast<const char*>(begin_), size_}; }

 private:
  void* begin_ = nullptr;
  size_t size_ = 0;
};

}  // namespace ombre::formats
