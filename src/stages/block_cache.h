// A cache of blocks of computed values that keeps the most recently used ones.
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

// A thread-safe cache of blocks.
class BlockCache {
 public:
  // The source that a block belongs to, and the number of the block there.
  struct Key {
    uint64_t owner = 0;
    std::array<int64_t, 3> number{};
    bool operator<(const Key& other) const { return std::tie(owner, number) < std::tie(other.owner, other.number); }
  };

  uint64_t new_owner();
  // Sets the limit in bytes. Blocks in use count, but are never dropped.
  void set_limit(size_t bytes);
  // Returns the block, and makes it first if it is missing. Two threads never make the same block at the same time.
  ValueBlockPtr get(const Key& key, const std::function<ValueBlock()>& make);

  struct Counts {
    size_t made = 0, dropped = 0, bytes = 0;
  };
  Counts counts() const;

 private:
  struct Entry {
    ValueBlockPtr block;  // null while the block is being made
    size_t bytes = 0;
    std::list<Key>::iterator use;
  };
  void put(const Key& key, const ValueBlockPtr& block);
  void drop_oldest();

  mutable std::mutex mutex_;
  std::condition_variable made_;
  std::map<Key, Entry> entries_;
  std::list<Key> uses_;  // keys of finished blocks, the most recently used first
  uint64_t last_owner_ = 0;
  size_t limit_ = size_t{1} << 30;
  Counts counts_;
};

}  // namespace ombre::compile
