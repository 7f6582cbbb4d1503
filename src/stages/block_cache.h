// Blocks of computed values, of which those that were used last are kept.
#pragma once

#include <array>
#include <condition_variable>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>

#include "stages/value_block.h"

namespace ombre::compile {

// Thread-safe.
class BlockCache {
 public:
  // A block is known by the source that it belongs to and its number there.
  struct Key {
    uint64_t owner = 0;
    std::array<int64_t, 3> number{};
    bool operator<(const Key& other) const { return std::tie(owner, number) < std::tie(other.owner, other.number); }
  };

  uint64_t new_owner();
  // Blocks that are in use count, but are never dropped.
  void set_limit(size_t bytes);
  // The block, made now if it is not there. Two threads never make the same block at the same time.
  ValueBlockPtr get(const Key& key, const std::function<ValueBlock()>& make);

  struct Counts {
    size_t made = 0, dropped = 0, bytes = 0;
  };
  Counts counts() const;

 private:
  struct Entry {
    ValueBlockPtr block;  // null while it is made
    size_t bytes = 0;
    std::list<Key>::iterator use;
  };
  void put(const Key& key, const ValueBlockPtr& block);
  void drop_oldest();

  mutable std::mutex mutex_;
  std::condition_variable made_;
  std::map<Key, Entry> entries_;
  std::list<Key> uses_;  // of blocks that are made, the latest first
  uint64_t last_owner_ = 0;
  size_t limit_ = size_t{1} << 30;
  Counts counts_;
};

}  // namespace ombre::compile
