#include "stages/block_cache.h"

namespace ombre::compile {

uint64_t BlockCache::new_owner() {
  const std::scoped_lock lock(mutex_);
  return ++last_owner_;
}

void BlockCache::set_limit(size_t bytes) {
  const std::scoped_lock lock(mutex_);
  limit_ = bytes;
  drop_oldest();
}

ValueBlockPtr BlockCache::get(const Key& key, const std::function<ValueBlock()>& make) {
  {
    std::unique_lock lock(mutex_);
    for (;;) {
      const auto [entry, is_new] = entries_.try_emplace(key);
      if (is_new) break;
      if (entry->second.block) {
        uses_.splice(uses_.begin(), uses_, entry->second.use);
        return entry->second.block;
      }
      made_.wait(lock);
    }
  }
  try {
    const auto block = std::make_shared<const ValueBlock>(make());
    put(key, block);
    return block;
  } catch (...) {
    const std::scoped_lock lock(mutex_);
    entries_.erase(key);
    made_.notify_all();
    throw;
  }
}

BlockCache::Counts BlockCache::counts() const {
  const std::scoped_lock lock(mutex_);
  return counts_;
}

void BlockCache::put(const Key& key, const ValueBlockPtr& block) {
  const std::scoped_lock lock(mutex_);
  Entry& entry = entries_.at(key);
  uses_.push_front(key);
  entry = {block, block->bytes(), uses_.begin()};
  counts_.bytes += entry.bytes;
  ++counts_.made;
  drop_oldest();
  made_.notify_all();
}

void BlockCache::drop_oldest() {
  while (counts_.bytes > limit_ && !uses_.empty()) {
    const auto oldest = entries_.find(uses_.back());
    counts_.bytes -= oldest->second.bytes;
    ++counts_.dropped;
    entries_.erase(oldest);
    uses_.pop_back();
  }
}

}  // namespace ombre::compile
