// Files that appear whole or not at all.
#pragma once

#include <string>
#include <string_view>

namespace ombre::exporting {

inline constexpr std::string_view part_suffix = ".part";  // of a file being written

// `flushed` survives a loss of power; without it a file survives the end of this program alone.
enum class Durability { closed, flushed };

// Writes beside `path`, then renames, replacing what has that name. On failure nothing is left
// behind and what was there before stays. Throws Error with the path, the reason and what to do.
void write_file(const std::string& path, std::string_view bytes, Durability durability = Durability::closed);

// Adds lines to the end of a file. Each append reaches the system in one call.
class AppendFile {
 public:
  // Creates the file where it is missing. Throws Error.
  explicit AppendFile(std::string path);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  void append(std::string_view bytes);

 private:
  std::string path_;
  int descriptor_ = -1;
};

// "cannot write PATH: REASON; WHAT TO DO", from an errno.
std::string write_failure(const std::string& path, int error);

}  // namespace ombre::exporting
