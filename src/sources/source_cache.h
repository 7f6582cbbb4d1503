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

// A source that is kept, with the remarks made about it.
struct CacheEntry {
  std::shared_ptr<const void> value;
  size_t bytes = 0;     // that it takes, all that is built on first use included; an estimate
  std::string name;     // by which the remarks call it
  SourceRange where;    // of the call that it was made for
  Diagnostics remarks;  // no errors
};
using CacheEntryPtr = std::shared_ptr<const CacheEntry>;

// One for a running program, which passes it to what loads designs. Keys are hashes of contents and options. What was
// used least recently is dropped first; what a design still uses is found as long as it does. Thread-safe.
class SourceCache {
 public:
  static constexpr size_t usual_bytes = size_t{1} << 30, largest_kept_text = size_t{1} << 20;
  explicit SourceCache(size_t most_bytes = usual_bytes) : most_bytes_(most_bytes) {}

  // Null if it is not there.
  CacheEntryPtr find(const Hash& key);
  // Keeps the first entry for a key, and returns that.
  CacheEntryPtr add(const Hash& key, CacheEntry entry);
  // The bytes of a file that is needed each time, such as a script; kept if they are at most a mebibyte. Throws Error.
  std::shared_ptr<const std::string> text(const std::string& path);

  FileStore& files() { return files_; }
  size_t bytes() const;  // of what is kept
  size_t most_bytes() const;
  void set_most_bytes(size_t bytes);

 private:
  struct Slot {
    std::weak_ptr<const CacheEntry> known;  // as long as somebody uses it
    std::list<std::pair<Hash, CacheEntryPtr>>::iterator kept;
    bool is_kept = false;
  };
  void keep(const Hash& key, Slot& slot, const CacheEntryPtr& entry);
  void drop_beyond(size_t bytes);
  void forget_unused();

  mutable std::mutex mutex_;
  FileStore files_;
  std::map<Hash, Slot> slots_;
  std::list<std::pair<Hash, CacheEntryPtr>> kept_;  // the most recently used first
  size_t most_bytes_, bytes_ = 0, next_sweep_ = 1024;
};

// The bytes of a file that a script includes; nothing where there is no such regular file, or it is larger than 256
// MiB.
std::optional<std::string> read_included(const std::string& path, SourceCache& cache);

}  // namespace ombre::sources
