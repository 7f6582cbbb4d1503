#include "sources/file_store.h"

#include <sys/stat.h>

#include <chrono>

#include "base/text/error.h"
#include "formats/containers/file.h"
#include "formats/containers/mapped_file.h"

namespace ombre::sources {
namespace {

// Greatest resolution of a file system's clock: two changes within it may have the same time.
constexpr auto longest_tick = std::chrono::milliseconds(50);

}  // namespace

FileStore::Stamp FileStore::stamp_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return {static_cast<int64_t>(status.st_dev), static_cast<int64_t>(status.st_ino), status.st_size,
          status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

bool FileStore::is_settled(const Stamp& stamp) {
  const auto modified = std::chrono::seconds(stamp[3]) + std::chrono::nanoseconds(stamp[4]);
  return std::chrono::system_clock::now().time_since_epoch() - modified > longest_tick;
}

bool FileStore::is_large(const Stamp& stamp) { return stamp[2] >= static_cast<int64_t>(large_file); }

FileStore::Content FileStore::content(const std::string& path) {
  const Stamp stamp = stamp_of(path);
  {
    const std::scoped_lock lock(mutex_);
    requested_.insert(path);
    const auto known = known_.find(path);
    if (known != known_.end() && known->second.stamp == stamp) return {known->second.hash, nullptr};
  }
  const bool may_be_kept = stamp != Stamp{} && is_settled(stamp);
  Content content = read_content(path);
  const std::scoped_lock lock(mutex_);
  if (may_be_kept && stamp_of(path) == stamp)
    known_[path] = {stamp, content.hash};
  else
    known_.erase(path);
  return content;
}

std::vector<std::string> FileStore::paths() const {
  const std::scoped_lock lock(mutex_);
  return {requested_.begin(), requested_.end()};
}

std::shared_ptr<const std::string> FileStore::bytes(const std::string& path, const Content& content) {
  if (content.bytes) return content.bytes;
  const Content now = read(path);
  if (now.hash != content.hash)
    throw Error(Code::cannot_read, "cannot read " + path + ": it changes while it is read", {{"file", path}});
  return now.bytes;
}

FileView FileStore::view(const std::string& path, const Content& content) {
  if (!content.bytes && is_large(stamp_of(path))) {
    ++reads_;
    const auto file = std::make_shared<const formats::MappedFile>(path);
    if (hash_bytes(file->bytes()) != content.hash)
      throw Error(Code::cannot_read, "cannot read " + path + ": it changes while it is read", {{"file", path}});
    return {file->bytes(), file, true};
  }
  auto all = bytes(path, content);
  return {*all, all};
}

// Returns the content of a file; for a large file only its hash.
FileStore::Content FileStore::read_content(const std::string& path) {
  if (!is_large(stamp_of(path))) return read(path);
  ++reads_;
  return {hash_bytes(formats::MappedFile(path).bytes()), nullptr};
}

FileStore::Content FileStore::read(const std::string& path) {
  ++reads_;
  auto bytes = std::make_shared<const std::string>(formats::read_file(path));
  const Hash hash = hash_bytes(*bytes);
  return {hash, std::move(bytes)};
}

}  // namespace ombre::sources
