// Files that appear whole or not at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/error.h"

namespace ombre::exporting {

inline constexpr std::string_view part_suffix = ".part";  // of a file being written

// `flushed` survives a loss of power; without it a file survives the end of this program alone.
enum class Durability { closed, flushed };

// Writes beside `path`, then renames, replacing what has that name. On failure nothing is left
// behind and what was there before stays. Throws Error with the path, the reason and what to do.
void write_file(const std::string& path, std::string_view bytes, Durability durability = Durability::closed);

// A name beside `path` for a file that is being written by others; what has it goes away unless it is committed.
class PendingFile {
 public:
  explicit PendingFile(std::string path) : path_(std::move(path)), part_(path_ + std::string(part_suffix)) {}
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const std::string& path() const { return path_; }
  const std::string& part() const { return part_; }
  // Gives it its name, replacing what has that. Throws Error.
  void commit();

 private:
  std::string path_, part_;
  bool is_committed_ = false;
};

// A file that is written piece by piece.
class NewFile {
 public:
  // Throws Error, as do the others.
  explicit NewFile(std::string path);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void append(std::string_view bytes);
  // Anywhere; what lies before it and was not written is 0.
  void write_at(uint64_t offset, std::string_view bytes);
  // The pieces so far are the file, which keeps its name of old until it is committed.
  void close(Durability durability = Durability::closed);
  void commit() { file_.commit(); }
  // Its name until then.
  const std::string& part() const { return file_.part(); }

 private:
  PendingFile file_;
  int descriptor_ = -1;
};

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
Error write_error(const std::string& path, int error);

}  // namespace ombre::exporting
