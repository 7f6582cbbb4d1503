#include "load/sub_design_cache.h"

#include <utility>

namespace ombre::compile {

std::shared_ptr<const void> SubDesignCache::find(const Hash& key) {
  const sources::CacheEntryPtr entry = cache_.find(key);
  if (!entry) return nullptr;
  ++found_;
  return {entry, entry->value.get()};  // the pointer keeps the entry alive
}

void SubDesignCache::keep(const Hash& key, std::shared_ptr<const void> made, size_t bytes) {
  ++made_;
  cache_.add(key, {std::move(made), bytes, {}, {}, {}});
}

}  // namespace ombre::compile
