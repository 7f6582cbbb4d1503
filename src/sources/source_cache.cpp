#include "sources/source_cache.h"

#include <filesystem>

#include "base/text/error.h"

namespace ombre::sources {

CacheEntryPtr SourceCache::find(const Hash& key) {
  const std::scoped_lock lock(mutex_);
  const auto slot = slots_.find(key);
  if (slot == slots_.end()) return nullptr;
  const CacheEntryPtr entry = slot->second.known.lock();
  if (entry) keep(key, slot->second, entry);
  return entry;
}

CacheEntryPtr SourceCache::add(const Hash& key, CacheEntry entry) {
  const auto made = std::make_shared<const CacheEntry>(std::move(entry));
  const std::scoped_lock lock(mutex_);
  forget_unused();
  Slot& slot = slots_[key];
  CacheEntryPtr counts = slot.known.lock();
  if (!counts) {
    slot.known = made;
    counts = made;
  }
  keep(key, slot, counts);
  return counts;
}

std::shared_ptr<const std::string> SourceCache::text(const std::string& path) {
  const FileStore::Content content = files_.content(path);
  const Hash key = hash_bytes("text " + content.hash.hex());
  CacheEntryPtr entry = find(key);
  if (!entry) {
    const auto bytes = files_.bytes(path, content);
    if (bytes->size() > largest_kept_text) return bytes;
    entry = add(key, {bytes, bytes->size(), path, {}, {}});
  }
  return std::static_pointer_cast<const std::string>(entry->value);
}

size_t SourceCache::bytes() const {
  const std::scoped_lock lock(mutex_);
  return bytes_;
}

size_t SourceCache::most_bytes() const {
  const std::scoped_lock lock(mutex_);
  return most_bytes_;
}

void SourceCache::set_most_bytes(size_t bytes) {
  const std::scoped_lock lock(mutex_);
  most_bytes_ = bytes;
  drop_beyond(most_bytes_);
}

void SourceCache::keep(const Hash& key, Slot& slot, const CacheEntryPtr& entry) {
  if (slot.is_kept) return kept_.splice(kept_.begin(), kept_, slot.kept);
  if (entry->bytes > most_bytes_) return;
  drop_beyond(most_bytes_ - entry->bytes);
  slot.kept = kept_.emplace(kept_.begin(), key, entry);
  slot.is_kept = true;
  bytes_ += entry->bytes;
}

void SourceCache::drop_beyond(size_t bytes) {
  while (bytes_ > bytes) {
    const auto& [key, entry] = kept_.back();
    bytes_ -= entry->bytes;
    slots_[key].is_kept = false;
    kept_.pop_back();
  }
}

// Removes the slots of expired sources, whenever there are twice as many as remained the last time.
void SourceCache::forget_unused() {
  if (slots_.size() < next_sweep_) return;
  std::erase_if(slots_, [](const auto& slot) { return slot.second.known.expired(); });
  next_sweep_ = std::max<size_t>(1024, 2 * slots_.size());
}

std::optional<std::string> read_included(const std::string& path, SourceCache& cache) {
  constexpr std::uintmax_t largest = 256u << 20;
  std::error_code status;
  if (!std::filesystem::is_regular_file(path, status) || std::filesystem::file_size(path, status) > largest)
    return std::nullopt;
  try {
    return *cache.text(path);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace ombre::sources
