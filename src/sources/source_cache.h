// A cache of sources, for designs that load the same again.
#pragma once

#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "base/system/hash.h"
#include "base/text/diagnostic.h"
#include "sources/file_store.h"

namespace ombre::sources {

// A cached source, with the remarks made about it.
struct CacheEntry {
  std::shared_ptr<const void> value;
  size_t bytes = 0;     // estimate of the memory used, including everything that is built on first use
  std::string name;     // name of the source in the remarks
  SourceRange where;    // the call for which it was made
  Diagnostics remarks;  // no errors
};
using CacheEntryPtr = std::shared_ptr<const CacheEntry>;

// The cache of a running program, passed to all that loads designs. Keys are hashes of contents and options. The least
// recently used entries are dropped first; an entry in use can be found as long as it is used. Thread-safe.
class SourceCache {
 public:
  static constexpr size_t usual_bytes = size_t{1} << 30, largest_kept_text = size_t{1} << 20;
  explicit SourceCache(size_t most_bytes = usual_bytes) : most_bytes_(most_bytes) {}

  // Returns the entry of a key, or null.
  CacheEntryPtr find(const Hash& key);
  // Adds an entry, and returns the one that was first added for the key.
  CacheEntryPtr add(const Hash& key, CacheEntry entry);
  // Returns the bytes of a file that is needed each time, such as a script; cached if they are at most 1 MiB. Throws
  // Error.
  std::shared_ptr<const std::string> text(const std::string& path);

  FileStore& files() { return files_; }
  size_t bytes() const;  // size of the cached entries
  size_t most_bytes() const;
  void set_most_bytes(size_t bytes);

 private:
  struct Slot {
    std::weak_ptr<const CacheEntry> known;  // valid as long as the entry is in use
    std::list<std::pair<Hash, CacheEntryPtr>>::iterator kept;
    bool is_kept = false;
  };
  void keep(const Hash& key, Slot& slot, const CacheEntryPtr& entry);
  void drop_beyond(size_t bytes);
  void forget_unused();

  mutable std::mutex mutex_;
  FileStore files_;
  std::map<Hash, Slot> slots_;
  std::list<std::pair<Hash, CacheEntryPtr>> kept_;  // most recently used first
  size_t most_bytes_, bytes_ = 0, next_sweep_ = 1024;
};

// Returns the bytes of a file that a script includes; null if it is not an existing regular file, or is larger than 256
// MiB.
std::optional<std::string> read_included(const std::string& path, SourceCache& cache);

}  // namespace ombre::sources
