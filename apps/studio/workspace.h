// The folder that the studio shows: its files are listed, read and saved, and nothing outside of it.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "studio/data_files.h"

namespace ombre::studio {

// What a file holds, and a hash of that, by which changes by others are noticed.
struct FileText {
  std::string text, version;
};

// The disk has another version than the one that was to be replaced.
struct SaveConflict {
  std::optional<FileText> disk;  // nothing: the file is gone
};

// Names are paths relative to the folder, with '/'. Throws RequestError for names that lead out of it, by "..", as
// absolute paths or through links, and for hidden ones. Thread-safe.
class Workspace {
 public:
  static constexpr size_t most_files = 2000;
  static constexpr size_t most_bytes = size_t{8} << 20;  // of a file that is edited

  // Throws Error when it is no folder.
  explicit Workspace(const std::filesystem::path& folder);

  const std::filesystem::path& root() const { return root_; }
  // Designs and scripts, sorted; presets, hidden folders and links to folders are left out.
  std::vector<std::string> list() const;
  // Scans, results and tables likewise; a folder of DICOM files is one scan.
  struct DataFile {
    std::string name;
    DataKind kind = DataKind::none;
  };
  std::vector<DataFile> list_data() const;
  // Those whose names end so (".stl", in small letters), sorted.
  std::vector<std::string> list_ending_in(const std::vector<std::string>& endings) const;
  std::filesystem::path path(const std::string& name) const;
  // The name of a file at this path; empty where it is not in the folder.
  std::string name_of(const std::filesystem::path& file) const;
  // Throws Error when it cannot be read, RequestError when it is too large or no text.
  FileText read(const std::string& name);
  // Replaces `version`, empty for a file that must not be there yet; the new version, or what is there instead.
  // The file that is there stays whole whatever happens. Throws Error.
  std::variant<std::string, SaveConflict> save(const std::string& name, const std::string& text,
                                               const std::string& version);

  // Files that were read or saved here and have another version on the disk than when last looked at.
  struct Change {
    std::string name, version;  // empty: it is gone
  };
  std::vector<Change> changes();

 private:
  struct Seen {
    std::filesystem::file_time_type time;
    uintmax_t bytes = 0;
    std::string version;
  };
  // Calls with the names of files and folders that are not hidden, until it returns false for a file; a folder is
  // entered if it returns true.
  void walk(const std::function<bool(const std::string& name, bool is_folder)>& take) const;
  void note(const std::string& name, const std::filesystem::path& file, const std::string& version);

  std::filesystem::path root_;
  std::mutex mutex_, save_mutex_;
  std::map<std::string, Seen> seen_;
};

bool is_design_name(const std::string& name);  // by its ending

}  // namespace ombre::studio
