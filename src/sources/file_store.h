// Files that designs name, read again only where they have changed.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "base/hash.h"

namespace ombre::sources {

// Thread-safe.
class FileStore {
 public:
  struct Content {
    Hash hash;
    std::shared_ptr<const std::string> bytes;  // null where the file is as it was when it was read last
  };
  // A file counts as unchanged if its device, inode, size and time of modification are those of the last reading, and
  // that time was not so recent that a later change could have the same. Throws Error.
  Content content(const std::string& path);
  // The bytes of a content that was found. Throws Error where the file has changed since.
  std::shared_ptr<const std::string> bytes(const std::string& path, const Content& content);
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
  Content read(const std::string& path);

  std::mutex mutex_;
  std::map<std::string, Known> known_;
  std::atomic<size_t> reads_ = 0;
};

}  // namespace ombre::sources
