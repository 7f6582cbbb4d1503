// The folder of the studio: lists, reads and saves its files, and nothing outside of it.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "studio/workspace/data_files.h"

namespace ombre::studio {

// The text of a file, and a hash of it, by which changes by others are noticed.
struct FileText {
  std::string text, version;
};

// A save failed since the disk has another version than the one to be replaced.
struct SaveConflict {
  std::optional<FileText> disk;  // nothing: the file is gone
};

// The files of a folder. Names are paths relative to it, with '/'. Throws RequestError for names that lead out of it,
// by "..", as absolute paths or through links, and for hidden ones. Thread-safe.
class Workspace {
 public:
  static constexpr size_t most_files = 2000;
  static constexpr size_t most_bytes = size_t{8} << 20;  // larger files are not edited

  // Throws Error when the path is no folder.
  explicit Workspace(const std::filesystem::path& folder);

  const std::filesystem::path& root() const { return root_; }
  // Lists designs and scripts, sorted, without presets, hidden folders and links to folders.
  std::vector<std::string> list() const;
  // Lists scans, results and tables in the same way; a folder of DICOM files is one scan.
  struct DataFile {
    std::string name;
    DataKind kind = DataKind::none;
  };
  std::vector<DataFile> list_data() const;
  // Lists the files whose names have one of these endings (".stl", in small letters), sorted.
  std::vector<std::string> list_ending_in(const std::vector<std::string>& endings) const;
  std::filesystem::path path(const std::string& name) const;
  // Returns the name of the file at this path; empty if the file is not in the folder.
  std::string name_of(const std::filesystem::path& file) const;
  // Throws Error when the file cannot be read, and RequestError when it is too large or no text.
  FileText read(const std::string& name);
  // Replaces the given version of the file; an empty version means that the file must not exist yet. Returns the new
  // version, or the conflicting content. The old file stays whole whatever happens. Throws Error.
  std::variant<std::string, SaveConflict> save(const std::string& name, const std::string& text,
                                               const std::string& version);

  // Lists the files that were read or saved here and have changed on the disk since the last call.
  struct Change {
    std::string name, version;  // an empty version: the file is gone
  };
  std::vector<Change> changes();

 private:
  struct Seen {
    std::filesystem::file_time_type time;
    uintmax_t bytes = 0;
    std::string version;
  };
  // Calls the function with the names of files and folders that are not hidden, until it returns false for a file; a
  // folder is entered if it returns true.
  void each_entry(const std::function<bool(const std::string& name, bool is_folder)>& take) const;
  void note(const std::string& name, const std::filesystem::path& file, const std::string& version);

  std::filesystem::path root_;
  std::mutex mutex_, save_mutex_;
  std::map<std::string, Seen> seen_;
};

// True if a name ends as those of designs do.
bool is_design_name(const std::string& name);

}  // namespace ombre::studio
