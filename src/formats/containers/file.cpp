// Reads whole files into memory.
#include "formats/containers/file.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "base/text/error.h"

namespace ombre::formats {
namespace {

constexpr size_t least_chunk = size_t{64} << 10, largest_file = size_t{16} << 30;

// Throws an error that also names the absolute path of a relative one.
[[noreturn]] void throw_unreadable(const std::string& path, const std::string& reason, Code code = Code::cannot_read) {
  std::string message = "cannot read " + path + ": " + reason;
  std::error_code ignored;
  const std::filesystem::path absolute = std::filesystem::absolute(path, ignored);
  if (!path.empty() && !std::filesystem::path(path).is_absolute() && !ignored)
    message += " (looked for " + absolute.lexically_normal().string() + ")";
  throw Error(code, message, {{"file", path}});
}

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

// True for a pipe that lies in a folder, whose reading may never end. Those of the shell, <(...), are files of /dev.
bool is_named_pipe(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_fifo(path, ignored) && !path.starts_with("/dev/") && !path.starts_with("/proc/");
}

}  // namespace

std::string read_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw_unreadable(path, "it is a directory");
  if (std::filesystem::is_character_file(path, ignored) || std::filesystem::is_block_file(path, ignored))
    throw_unreadable(path, "it is a device");
  if (is_named_pipe(path)) throw_unreadable(path, "it is a pipe; write <(cat PIPE) to read it");
  errno = 0;
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file)
    throw_unreadable(path, std::generic_category().message(errno),
                     errno == ENOENT ? Code::file_missing : Code::cannot_read);

  // With one byte more than the known size, the end of the file is detected without another chunk.
  const uintmax_t size = std::filesystem::file_size(path, ignored);
  std::string bytes(ignored ? least_chunk : static_cast<size_t>(size) + 1, '\0');
  size_t filled = 0;
  for (;;) {
    filled += std::fread(bytes.data() + filled, 1, bytes.size() - filled, file.get());
    if (filled < bytes.size()) break;
    if (filled > largest_file) throw_unreadable(path, "it has more than 16 GiB");
    bytes.resize(2 * bytes.size() + least_chunk);
  }
  if (std::ferror(file.get()) != 0) throw_unreadable(path, std::generic_category().message(errno));
  bytes.resize(filled);
  return bytes;
}

}  // namespace ombre::formats
