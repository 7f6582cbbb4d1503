// Zip archives by libzip. There is no reader in builds without it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/module_loader.h"
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
};

// Compressed, all dated 1980-01-01. Throws std::system_error where the disk fails, std::runtime_error otherwise,
// Error in builds without libzip. The file is made under another name beside `path` and renamed.
void write_zip(const std::string& path, const std::vector<ZipEntry>& entries);
// False in builds without libzip.
bool can_write_zip();

inline bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

// Reads entries into memory; nothing is ever unpacked onto the disk. What is wrong with the archive is reported and
// ends the reading by DesignError.
class ZipReader {
 public:
  // More than this in all, or packed more tightly than meshes ever are, is taken for an attack.
  static constexpr uint64_t most_bytes = uint64_t{1} << 30;
  static constexpr uint64_t most_entries = 10'000;
  static constexpr uint64_t most_ratio = 200, small_entry_bytes = uint64_t{16} << 20;

  // `name` and the bytes must live as long. `ratio` is how tightly files may be packed.
  ZipReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics, uint64_t ratio = most_ratio);
  ~ZipReader();
  ZipReader(const ZipReader&) = delete;
  ZipReader& operator=(const ZipReader&) = delete;

  const std::vector<std::string>& names() const { return names_; }
  // Names are compared as OPC does, and as its careless writers need it: either case, / or \, %20 for a blank, with or
  // without / and ./ at the beginning. A name that fits exactly comes first.
  bool has(const std::string& entry) const { return find(entry).has_value(); }
  std::string read(const std::string& entry);
  // Does the archive say that the entry is a symbolic link, as those of Unix can?
  bool is_link(const std::string& entry) const;

 private:
  std::optional<size_t> find(const std::string& entry) const;
  void check(const std::string& entry, const struct zip_stat& stat) const;
  [[noreturn]] void fail_entry(const std::string& entry, const std::string& problem,
                               const std::string& hint = "") const;

  const std::string& name_;
  Diagnostics& diagnostics_;
  uint64_t ratio_;
  zip* archive_ = nullptr;
  std::vector<std::string> names_;        // as in the archive, by index
  std::map<std::string, size_t> by_key_;  // the first of each
  uint64_t bytes_read_ = 0;
};

}  // namespace ombre::formats
