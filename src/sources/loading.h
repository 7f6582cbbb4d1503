// Common tools for loading the requested sources.
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

// Loads the sources that one design requests. Thread-safe.
class Loader : public design::SourceLoader {
 public:
  // Constructs a loader. `stop`, which may be null, ends long work. Both pointers must outlive the loader. `threads` 0
  // means all cores.
  explicit Loader(SourceCache& cache, const StopFlag* stop = nullptr, int threads = 0)
      : cache_(cache), stop_(stop), threads_(threads) {}

  SourceCache& cache() { return cache_; }
  const StopFlag* stop() const { return stop_; }
  int threads() const { return threads_; }
  // Returns true the first time that the design gets the source with this key.
  bool is_new(const Hash& key);
  // Remembers a volume that keeps the axes of its file. Returns the path of the first one with other axes of a patient,
  // once for a design; else an empty text.
  std::string first_with_other_axes(const std::string& path, design::PatientSpace space);

 protected:
  std::shared_ptr<const void> find(design::SourceRequest request, const design::Reader& reader) override;

 private:
  SourceCache& cache_;
  const StopFlag* stop_;
  int threads_;
  std::mutex mutex_;
  std::set<Hash> reported_;
  std::map<design::PatientSpace, std::string> first_in_space_;
  bool has_reported_axes_ = false;
};

// Returns what to write instead of a name that a file does not have: the one that may have been meant, or its names;
// `without_names` if it has none.
std::string hint_of_names(const std::string& name, std::vector<std::string> names, const std::string& without_names);

// A key of everything that determines a source. Words are stored with their lengths, so that different lists of words
// give different keys.
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

// Returns the path of a file that another one names, relative to its folder.
design::FilePath beside(const design::FilePath& file, const std::string& name);

// The contents of files beside another one, by the names that it has for them.
using FilesBeside = std::map<std::string, std::shared_ptr<const std::string>>;

// The loading of one request.
class Loading {
 public:
  Loading(Loader& loader, const design::Reader& reader) : loader_(loader), reader_(reader) {}

  const design::Reader& reader() const { return reader_; }
  const StopFlag* stop() const { return loader_.stop(); }
  int threads() const { return loader_.threads(); }
  Loader& loader() const { return loader_; }

  // Returns the bytes of a file that a script includes; null if it does not exist or is larger than 256 MiB.
  std::optional<std::string> included(const std::string& path);
  // Finds the file that a design names: beside the script, then beside the script's link target, then in the working
  // directory. Returns false, with a diagnostic, if it does not exist.
  bool find(design::FilePath& file);
  // Sets the content of a file. Returns false, with a diagnostic, if it cannot be read.
  bool read_content(design::FilePath& file);
  // Reads the files beside a file that hold parts of it, of a kind such as "images": those that `names` returns, as
  // paths relative to its folder, or none if it is null. The content of the file is then that of all. Returns nothing,
  // with a diagnostic, if one of them cannot be read.
  using NamesOfFiles = std::vector<std::string> (*)(const std::string& name, std::string_view bytes);
  std::optional<FilesBeside> read_beside(design::FilePath& file, std::string_view kind, NamesOfFiles names);
  // Returns the bytes of a file whose content is set. Throws Error.
  std::shared_ptr<const std::string> bytes(const design::FilePath& file);
  // Returns a view of the bytes of a file whose content is set; large files are mapped. Throws Error.
  FileView view(const design::FilePath& file);

  // A value made for a key, and the memory that it uses; null, with diagnostics, if making it failed.
  template <class T>
  struct Made {
    std::shared_ptr<const T> value;
    size_t bytes = 0;
  };
  // Returns the cached value of a key, else that which `make` returns for a reader. The diagnostics of a cached value
  // are repeated, once for each design; `name` is the design's name for the source. An Error becomes a diagnostic.
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
