// Tools with which each kind of source loads what was requested.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "base/system/progress.h"
#include "design/source_loader.h"
#include "sources/source_cache.h"

namespace ombre::sources {

// Loads what one design requests. Thread-safe.
class Loader : public design::SourceLoader {
 public:
  // `stop`, which may be null, ends what takes long. Both outlive the loader. `threads` 0: all cores.
  explicit Loader(SourceCache& cache, const StopFlag* stop = nullptr, int threads = 0)
      : cache_(cache), stop_(stop), threads_(threads) {}

  SourceCache& cache() { return cache_; }
  const StopFlag* stop() const { return stop_; }
  int threads() const { return threads_; }
  // Is this the first time that the design gets what has this key?
  bool is_new(const Hash& key);

 protected:
  std::shared_ptr<const void> find(design::SourceRequest request, const design::Reader& reader) override;

 private:
  SourceCache& cache_;
  const StopFlag* stop_;
  int threads_;
  std::mutex mutex_;
  std::set<Hash> reported_;
};

// Text in which what decides a source stands, each word ended so that no two lists of words are alike.
class Key {
 public:
  explicit Key(std::string_view kind) { add(kind); }
  Key& add(std::string_view word);
  Key& add(double number);
  Key& add(const Hash& content) { return add(content.hex()); }
  Hash hash() const { return hash_bytes(text_); }

 private:
  std::string text_;
};

// One request.
class Loading {
 public:
  Loading(Loader& loader, const design::Reader& reader) : loader_(loader), reader_(reader) {}

  const design::Reader& reader() const { return reader_; }
  const StopFlag* stop() const { return loader_.stop(); }
  int threads() const { return loader_.threads(); }

  // The bytes of a file that a script includes; nothing where there is none, or it is larger than 256 MiB.
  std::optional<std::string> included(const std::string& path);
  // The file that a design names: beside the script first, then beside what this links to, then in the working
  // directory. False, and a diagnostic, when there is none.
  bool find(design::FilePath& file);
  // False, and a diagnostic, when it cannot be read. Notes its content.
  bool read_content(design::FilePath& file);
  // The bytes of a file that was looked at. Throws Error.
  std::shared_ptr<const std::string> bytes(const design::FilePath& file);
  // The same; large files stay on disk. Throws Error.
  FileView view(const design::FilePath& file);

  // What is made for a key, and the memory that it takes; null, and diagnostics, where that fails.
  template <class T>
  struct Made {
    std::shared_ptr<const T> value;
    size_t bytes = 0;
  };
  // What was made for the key before, else what `make` returns for a reader. What was said then is said again, once
  // for each design; `name` is the one that it calls the source by. An Error becomes a diagnostic.
  template <class T, class Make>
  std::shared_ptr<const T> cached(const Hash& key, const std::string& name, const Make& make) {
    const CacheEntryPtr entry = entry_for(key, name, [&](const design::Reader& reader) {
      Made<T> made = make(reader);
      return std::pair(std::shared_ptr<const void>(std::move(made.value)), made.bytes);
    });
    if (!entry) return nullptr;
    return {entry, static_cast<const T*>(entry->value.get())};
  }

 private:
  using MakeAny = std::function<std::pair<std::shared_ptr<const void>, size_t>(const design::Reader&)>;
  CacheEntryPtr entry_for(const Hash& key, const std::string& name, const MakeAny& make);
  void report_again(const CacheEntry& entry) const;

  Loader& loader_;
  const design::Reader& reader_;
  std::map<std::string, FileStore::Content> contents_;
};

}  // namespace ombre::sources
