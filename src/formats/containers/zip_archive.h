// Zip archives by libzip. Builds without it have no reader.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/module_loader.h"
#include "base/system/not_copied.h"
#include "base/text/diagnostic.h"
#include "formats/containers/lazy_bytes.h"

struct zip;
struct zip_stat;

namespace ombre::formats {

inline constexpr Module zip_module{"ombre_libzip", "libzip",    "zip archives",
                                   "libzip-dev",   "OMBRE_3MF", "write or read files of another kind"};

struct ZipEntry {
  std::string name;
  LazyBytes bytes;
  bool is_packed = false;  // the bytes are compressed already, as those of a PNG are, and are stored as they are
};

// Writes an archive with all entries dated 1980-01-01. It is written under another name beside `path` and
// renamed. Throws std::system_error for I/O errors, std::runtime_error for others, and Error in builds without libzip.
void write_zip(const std::string& path, const std::vector<ZipEntry>& entries);
// Returns false in builds without libzip.
bool can_write_zip();

inline bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

// Archives that exceed these limits, or are packed more tightly than meshes ever are, are treated as attacks.
struct ZipLimits {
  uint64_t ratio = 200;       // of the bytes of an entry to its packed bytes
  uint64_t entries = 10'000;  // further ones are not seen
  bool keeps_all = true;      // true if the caller keeps what it reads, so that the sum of all bytes is bounded
};

// Reads entries into memory, never to disk. Errors in the archive are reported, and DesignError is thrown.
class ZipReader : NotCopied {
 public:
  static constexpr uint64_t most_bytes = uint64_t{1} << 30;
  static constexpr uint64_t small_entry_bytes = uint64_t{16} << 20;

  // Opens an archive; `name` and the bytes must outlive this object.
  ZipReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics, ZipLimits limits = {});
  ~ZipReader();

  const std::vector<std::string>& names() const { return names_; }
  // Names are compared as in OPC, with tolerance for incorrect writers: in either case, with / or \, with %20 for a
  // blank, with or without a leading / or ./. An exact match takes precedence.
  bool has(const std::string& entry) const { return find(entry).has_value(); }
  std::string read(const std::string& entry);
  // Returns true if the archive marks the entry as a symbolic link.
  bool is_link(const std::string& entry) const;

 private:
  std::optional<size_t> find(const std::string& entry) const;
  void check(const std::string& entry, const struct zip_stat& stat) const;
  [[noreturn]] void fail_entry(const std::string& entry, const std::string& problem,
                               const std::string& hint = "") const;

  const std::string& name_;
  Diagnostics& diagnostics_;
  ZipLimits limits_;
  zip* archive_ = nullptr;
  std::vector<std::string> names_;        // in the order of the archive
  std::map<std::string, size_t> by_key_;  // the first entry of each key
  uint64_t bytes_read_ = 0;
};

}  // namespace ombre::formats
