// The folder that the studio shows. Its files are listed, read and saved, and nothing outside of it.
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

// The text of a file, and a hash of it, by which changes by other programs are noticed.
struct FileText {
  std::string text, version;
};

// A conflict: the file on disk has another version than the one to be replaced.
struct SaveConflict {
  std::optional<FileText> disk;  // null if the file no longer exists
};

// Access to the folder. Names are paths relative to it, with '/'. Throws RequestError for hidden names, and for names
// outside of the folder: with "..", absolute, or through links. Thread-safe.
class Workspace {
 public:
  static constexpr size_t most_files = 2000;
  static constexpr size_t most_bytes = size_t{8} << 20;  // larger files cannot be edited

  // Opens a folder. Throws Error if the path is not a folder.
  explicit Workspace(const std::filesystem::path& folder);

  const std::filesystem::path& root() const { return root_; }
  // Lists designs and scripts, sorted, without presets, hidden folders and links to folders.
  std::vector<std::string> list() const;
  // Lists scans, results, tables and models likewise; a folder of DICOM files is one scan.
  struct DataFile {
    std::string name;
    DataKind kind = DataKind::none;
  };
  std::vector<DataFile> list_data() const;
  // Lists the files whose names have one of these endings (such as ".stl", in lower case), sorted.
  std::vector<std::string> list_ending_in(const std::vector<std::string>& endings) const;
  std::filesystem::path path(const std::string& name) const;
  // Returns the path of a file, which may not exist yet. Throws RequestError also for pipes, sockets and devices, whose
  // reading might never end.
  std::filesystem::path plain_path(const std::string& name) const;
  // Returns the name of the file at this path; empty if it is not in the folder.
  std::string name_of(const std::filesystem::path& file) const;
  // Reads a file. Throws Error if it cannot be read, and RequestError if it is too large or not text.
  FileText read(const std::string& name);
  // Replaces the given version of a file, or creates it if the version is empty. Returns the new version, or a
  // conflict. The existing file is never left incomplete. Throws Error.
  std::variant<std::string, SaveConflict> save(const std::string& name, const std::string& text,
                                               const std::string& version);

  // Lists the files that were read or saved here and have changed on disk since the last call.
  struct Change {
    std::string name, version;  // the version is empty if the file no longer exists
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

// Returns true if a name ends like that of a design.
bool is_design_name(const std::string& name);

}  // namespace ombre::studio
