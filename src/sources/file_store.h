// Files that designs name, read again only where they have changed.
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

// Bytes of a file, and what keeps them.
struct FileView {
  std::string_view bytes;
  std::shared_ptr<const void> keeper;
  bool is_mapped = false;  // does it stay on disk?
};

// Thread-safe.
class FileStore {
 public:
  struct Content {
    Hash hash;
    std::shared_ptr<const std::string> bytes;  // null where the file is as it was when it was read last, or is large
  };
  // Files from this size on are mapped where that is enough.
  static constexpr uint64_t large_file = uint64_t{256} << 20;
  // A file counts as unchanged if its device, inode, size and time of modification are those of the last reading, and
  // that time was not so recent that a later change could have the same. Throws Error.
  Content content(const std::string& path);
  // The bytes of a content that was found. Throws Error where the file has changed since.
  std::shared_ptr<const std::string> bytes(const std::string& path, const Content& content);
  // The same; large files stay on disk.
  FileView view(const std::string& path, const Content& content);
  // The files whose contents were asked for, sorted.
  std::vector<std::string> paths() const;
  // How often a file was read.
  size_t reads() const { return reads_; }

 private:
  using Stamp = std::array<int64_t, 5>;  // device, inode, size, seconds and nanoseconds of the last modification
  struct Known {
    Stamp stamp;
    Hash hash;
  };
  // Zeros for what is no regular file.
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
