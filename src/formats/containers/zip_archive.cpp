#ifdef OMBRE_3MF

#include "formats/containers/zip_archive.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "base/system/module_loader.h"
#include "base/text/text.h"
#include "formats/containers/libzip_calls.h"
#include "formats/containers/text_scanner.h"

namespace ombre::formats {
namespace {

// libzip is loaded when the first archive is read or written.
const LibzipCalls& libzip() {
  static const LibzipCalls& calls = *load_function<decltype(ombre_libzip_calls)>(zip_module, "ombre_libzip_calls")();
  return calls;
}

// The earliest date in zip files: 1980-01-01 00:00.
constexpr uint16_t first_date = 1 << 5 | 1, midnight = 0;

// At this level files are a tenth larger than at level 9, in an eighth of the time.
constexpr uint32_t compression_level = 5;

// The bytes of an entry, as a source for libzip.
class EntrySource {
 public:
  explicit EntrySource(const LazyBytes& bytes) : bytes_(bytes), size_(bytes.size()) {}

  static zip_int64_t call(void* self, void* data, zip_uint64_t length, zip_source_cmd_t command) {
    try {
      return static_cast<EntrySource*>(self)->answer(data, length, command);
    } catch (const std::exception&) {
      return -1;
    }
  }

 private:
  zip_int64_t answer(void* data, zip_uint64_t length, zip_source_cmd_t command) {
    switch (command) {
      case ZIP_SOURCE_OPEN:
        reader_.emplace(bytes_);
        rest_ = {};
        return 0;
      case ZIP_SOURCE_READ:
        return read(static_cast<char*>(data), length);
      case ZIP_SOURCE_STAT:
        return fill_stat(static_cast<zip_stat_t*>(data));
      case ZIP_SOURCE_ERROR:
        return libzip().error_to_data(zip_error_in_memory(), data, length);
      case ZIP_SOURCE_CLOSE:
      case ZIP_SOURCE_FREE:
        return 0;
      case ZIP_SOURCE_SUPPORTS:
        return libzip().source_make_command_bitmap(ZIP_SOURCE_OPEN, ZIP_SOURCE_READ, ZIP_SOURCE_CLOSE, ZIP_SOURCE_STAT,
                                                   ZIP_SOURCE_ERROR, ZIP_SOURCE_FREE, -1);
      default:
        return -1;
    }
  }

  static zip_error_t* zip_error_in_memory() {
    static thread_local zip_error_t error;
    libzip().error_init_with_code(&error, ZIP_ER_MEMORY);
    return &error;
  }

  zip_int64_t read(char* to, uint64_t length) {
    uint64_t filled = 0;
    while (filled < length) {
      if (rest_.empty()) rest_ = reader_->next();
      if (rest_.empty()) break;
      const size_t count = std::min<uint64_t>(rest_.size(), length - filled);
      std::memcpy(to + filled, rest_.data(), count);
      rest_.remove_prefix(count);
      filled += count;
    }
    return static_cast<zip_int64_t>(filled);
  }

  zip_int64_t fill_stat(zip_stat_t* stat) const {
    libzip().stat_init(stat);
    stat->valid = ZIP_STAT_SIZE;
    stat->size = size_;
    return sizeof *stat;
  }

  const LazyBytes& bytes_;
  uint64_t size_;
  std::optional<LazyBytesReader> reader_;
  std::string_view rest_;
};

[[noreturn]] void throw_failure(zip_error_t* error) {
  if (libzip().error_system_type(error) == ZIP_ET_SYS && libzip().error_code_system(error) != 0)
    throw std::system_error(libzip().error_code_system(error), std::generic_category());
  throw std::runtime_error(libzip().error_strerror(error));
}

// Discards an archive that was not closed.
struct Discard {
  void operator()(zip_t* archive) const { libzip().discard(archive); }
};
using Archive = std::unique_ptr<zip_t, Discard>;

Archive create(const std::string& path) {
  int code = 0;
  Archive archive(libzip().open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
  if (archive) return archive;
  zip_error_t error;
  libzip().error_init_with_code(&error, code);
  throw_failure(&error);
}

void add(zip_t* archive, const ZipEntry& added, EntrySource& bytes) {
  zip_source_t* const source = libzip().source_function(archive, &EntrySource::call, &bytes);
  if (!source) throw_failure(libzip().get_error(archive));
  // Names are ASCII. With ZIP_FL_ENC_UTF_8, the bytes would depend on the version of libzip.
  const zip_int64_t index = libzip().file_add(archive, added.name.c_str(), source, ZIP_FL_ENC_GUESS);
  if (index < 0) {
    libzip().source_free(source);
    throw_failure(libzip().get_error(archive));
  }
  const auto entry = static_cast<zip_uint64_t>(index);
  if (libzip().set_file_compression(archive, entry, added.is_packed ? ZIP_CM_STORE : ZIP_CM_DEFLATE,
                                    compression_level) != 0 ||
      libzip().file_set_dostime(archive, entry, midnight, first_date, 0) != 0)
    throw_failure(libzip().get_error(archive));
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

// Returns a key that is equal for all spellings of an entry's name.
std::string name_key(std::string_view name) {
  const std::string lower = to_lower(name);
  std::string key;
  for (size_t i = 0; i < lower.size(); ++i) {
    char c = lower[i];
    if (c == '%' && i + 2 < lower.size() && hex_digit(lower[i + 1]) >= 0 && hex_digit(lower[i + 2]) >= 0) {
      c = static_cast<char>(16 * hex_digit(lower[i + 1]) + hex_digit(lower[i + 2]));
      i += 2;
    }
    key += c == '\\' ? '/' : c;
  }
  while (key.starts_with('/') || key.starts_with("./")) key.erase(0, key[0] == '/' ? 1 : 2);
  return to_lower(key);
}

}  // namespace

void write_zip(const std::string& path, const std::vector<ZipEntry>& entries) {
  std::vector<std::unique_ptr<EntrySource>> sources;
  for (const ZipEntry& entry : entries) sources.push_back(std::make_unique<EntrySource>(entry.bytes));
  Archive archive = create(path);
  for (size_t i = 0; i < entries.size(); ++i) add(archive.get(), entries[i], *sources[i]);
  if (libzip().close(archive.get()) != 0) throw_failure(libzip().get_error(archive.get()));
  static_cast<void>(archive.release());  // closing has freed it
}

bool can_write_zip() { return true; }

ZipReader::ZipReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics, ZipLimits limits)
    : name_(name), diagnostics_(diagnostics), limits_(limits) {
  zip_error_t error;
  libzip().error_init(&error);
  zip_source_t* const source = libzip().source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source) archive_ = libzip().open_from_source(source, ZIP_RDONLY, &error);
  libzip().error_fini(&error);
  if (!archive_) {
    if (source) libzip().source_free(source);
    fail(diagnostics, name, "this zip archive is damaged or cut short", "save or copy it again");
  }
  const zip_int64_t count = libzip().get_num_entries(archive_, 0);
  for (zip_int64_t i = 0; i < std::min(count, static_cast<zip_int64_t>(limits_.entries)); ++i) {
    const char* const entry = libzip().get_name(archive_, static_cast<zip_uint64_t>(i), 0);
    names_.emplace_back(entry ? entry : "");
    by_key_.emplace(name_key(names_.back()), names_.size() - 1);
  }
}

ZipReader::~ZipReader() {
  if (archive_) libzip().discard(archive_);
}

void ZipReader::fail_entry(const std::string& entry, const std::string& problem, const std::string& hint) const {
  fail(diagnostics_, name_, "the archive's file " + formats::quoted(entry) + ' ' + problem, hint);
}

std::optional<size_t> ZipReader::find(const std::string& entry) const {
  const auto near = by_key_.find(name_key(entry));
  if (near == by_key_.end()) return std::nullopt;
  if (names_[near->second] == entry) return near->second;
  const auto exact = std::find(names_.begin(), names_.end(), entry);
  return exact == names_.end() ? near->second : static_cast<size_t>(exact - names_.begin());
}

// The sizes stated by an entry are used only to reject it early.
void ZipReader::check(const std::string& entry, const struct zip_stat& stat) const {
  if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && stat.encryption_method != ZIP_EM_NONE)
    fail_entry(entry, "is encrypted", "save it without a password");
  if (stat.size > most_bytes - bytes_read_)
    fail_entry(entry, "has " + format_count(stat.size) + " bytes unpacked; of an archive at most " +
                          format_count(most_bytes) + " bytes are read");
  if (stat.size > small_entry_bytes && stat.size / limits_.ratio > stat.comp_size)
    fail_entry(entry, "is packed more tightly than " + format_count(limits_.ratio) + " to 1 (" +
                          format_count(stat.size) + " bytes into " + format_count(stat.comp_size) +
                          "), which is taken for an attack on memory");
}

bool ZipReader::is_link(const std::string& entry) const {
  constexpr unsigned kind_mask = 0170000, link = 0120000, mode_shift = 16;
  zip_uint8_t system = 0;
  zip_uint32_t attributes = 0;
  const auto index = find(entry);
  if (!index || libzip().file_get_external_attributes(archive_, *index, 0, &system, &attributes) != 0) return false;
  return system == ZIP_OPSYS_UNIX && (attributes >> mode_shift & kind_mask) == link;
}

std::string ZipReader::read(const std::string& entry) {
  zip_stat_t stat;
  const auto index = find(entry);
  if (!index || libzip().stat_index(archive_, *index, 0, &stat) != 0) fail_entry(entry, "is missing");
  check(entry, stat);
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(libzip().fopen_index(archive_, stat.index, 0),
                                                               libzip().fclose);
  if (!file) fail_entry(entry, std::string("cannot be unpacked: ") + libzip().strerror(archive_));

  // Memory is allocated as bytes arrive.
  constexpr uint64_t piece = uint64_t{1} << 20;
  std::string bytes;
  for (;;) {
    const size_t filled = bytes.size();
    bytes.resize(filled + std::min(piece, stat.size - filled + 1));
    const zip_int64_t got = libzip().fread(file.get(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0) fail_entry(entry, std::string("cannot be unpacked: ") + libzip().file_strerror(file.get()));
    bytes.resize(filled + static_cast<size_t>(got));
    if (bytes.size() > stat.size) fail_entry(entry, "is larger than the archive says");
    if (got == 0) break;
  }
  if (limits_.keeps_all) bytes_read_ += bytes.size();
  return bytes;
}

}  // namespace ombre::formats

#endif
