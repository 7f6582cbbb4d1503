// Reads the files that designs name, again only if they have changed.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/hash.h"

namespace ombre::sources {

// Bytes of a file, and the object that keeps them in memory.
struct FileView {
  std::string_view bytes;
  std::shared_ptr<const void> keeper;
  bool is_mapped = false;  // true if the bytes are mapped from disk
};

// A store of the files' contents. Thread-safe.
class FileStore {
 public:
  struct Content {
    Hash hash;
    std::shared_ptr<const std::string> bytes;  // null if the file is large or unchanged since it was last read
  };
  // Size in bytes from which files are mapped where possible.
  static constexpr uint64_t large_file = uint64_t{256} << 20;
  // Returns the content of a file. A file counts as unchanged if its device, inode, size and modification time are
  // those of the last reading, unless that time was so recent that a later change could have the same. Throws Error.
  Content content(const std::string& path);
  // Returns the bytes of a known content. Throws Error if the file has changed since.
  std::shared_ptr<const std::string> bytes(const std::string& path, const Content& content);
  // Returns a view of the bytes of a known content; large files are mapped. Throws Error if the file has changed since.
  FileView view(const std::string& path, const Content& content);
  // Returns the requested files, sorted.
  std::vector<std::string> paths() const;
  // Returns how often files were read.
  size_t reads() const { return reads_; }

 private:
  using Stamp = std::array<int64_t, 5>;  // device, inode, size, seconds and nanoseconds of the modification time
  struct Known {
    Stamp stamp;
    Hash hash;
  };
  // Returns the stamp of a file; zeros if it is not a regular file.
  static Stamp stamp_of(const std::string& path);
  static bool is_settled(const Stamp& stamp);
  static bool is_large(const Stamp& stamp);
  Content read(const std::string& path);
  Content read_content(const std::string& path);

  mutable std::mutex mutex_;
  std::map<std::string, Known> known_;
  std::set<std::string> requested_;
  std::atomic<size_t> reads_ = 0;
};

}  // namespace ombre::sources
