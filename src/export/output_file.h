// Writes files atomically: they appear complete or not at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "base/system/not_copied.h"
#include "base/text/error.h"

namespace ombre::exporting {

inline constexpr std::string_view part_suffix = ".part";  // ending of a file that is being written

// A `flushed` file survives a power failure; a `closed` one survives only the end of this program.
enum class Durability { closed, flushed };

// Writes to a file beside `path`, then renames it, replacing a file of that name. On failure nothing is left behind,
// and an existing file stays unchanged. Throws Error with the path, the reason and what to do.
void write_file(const std::string& path, std::string_view bytes, Durability durability = Durability::closed);

// A temporary name beside `path` for a file that other code writes; the file is removed unless it is committed.
class PendingFile : NotCopied {
 public:
  explicit PendingFile(std::string path) : path_(std::move(path)), part_(path_ + std::string(part_suffix)) {}
  ~PendingFile();

  const std::string& path() const { return path_; }
  const std::string& part() const { return part_; }
  // Renames the file to its final name, replacing a file of that name. Throws Error.
  void commit();

 private:
  std::string path_, part_;
  bool is_committed_ = false;
};

// A file that is written piece by piece.
class NewFile : NotCopied {
 public:
  // Creates the temporary file. Throws Error, as do the other functions.
  explicit NewFile(std::string path);
  ~NewFile();

  void append(std::string_view bytes);
  // Writes at any offset; unwritten bytes before it are 0.
  void write_at(uint64_t offset, std::string_view bytes);
  // Completes the file, which keeps its temporary name until it is committed.
  void close(Durability durability = Durability::closed);
  void commit() { file_.commit(); }
  // Returns the temporary name.
  const std::string& part() const { return file_.part(); }

 private:
  PendingFile file_;
  int descriptor_ = -1;
};

// Adds lines to the end of a file, each in one write call.
class AppendFile : NotCopied {
 public:
  // Opens the file, or creates it. Throws Error.
  explicit AppendFile(std::string path);
  ~AppendFile();

  void append(std::string_view bytes);

 private:
  std::string path_;
  int descriptor_ = -1;
};

// Returns an error with the message "cannot write PATH: REASON; WHAT TO DO" for an errno.
Error write_error(const std::string& path, int error);

}  // namespace ombre::exporting
