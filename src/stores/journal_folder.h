// A folder with a journal, and the files of the pieces that the journal names.
//
// A run can end at any moment and be resumed, by this order of events. The description of the job is written before the
// first piece. Each file of a piece is written aside and renamed; then the piece's line is added to the journal. A
// resumed run trusts a line only if the files that it names have the sizes and the hashes that it states.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/progress.h"
#include "export/output_file.h"
#include "stores/store.h"
#include "stores/stored_job.h"

namespace ombre::stores {

inline constexpr const char* journal_file = "journal.jsonl";

// How files of earlier runs are read, which takes time for large jobs. Progress and stop flag may be null; reading
// throws Cancelled when asked to stop.
struct Checking {
  int threads = 0;  // 0: all cores
  Progress* progress = nullptr;
  const StopFlag* stop = nullptr;
};

// Returns the name of the file that `name` is an unfinished part of, else `name`.
std::string_view without_part(std::string_view name);
// Makes the folder, or throws Error.
void make_folder(const std::string& path, const JobWords& words);
// Throws Error if the path is a file.
void refuse_file(const std::string& path, const JobWords& words);

// Says of each entry whether its files lie in the folder with the sizes and hashes that the entry states.
std::vector<char> are_proven(const std::string& folder, const std::vector<const Entry*>& entries,
                             const Checking& checking);

class JournalFolder {
 public:
  JournalFolder(std::string path, const StoredJob& job, std::string journal);

  const std::string& path() const { return path_; }
  const Entries& finished() const { return finished_; }
  // Returns the path of a file of the folder.
  std::string file(std::string_view name) const;
  bool holds(std::string_view name) const;
  std::string read(std::string_view name) const;

  // Returns the description that lies there, if it can be read. Throws if it is of another job.
  std::optional<Data> description() const;
  void check_description() const;
  // Throws an error that a file of others has a name that the job would write.
  [[noreturn]] void refuse_collision(const std::string& name) const;

  // Reads the finished pieces of earlier runs from the folder's own journal.
  void read_journal(const Checking& checking) { read_journals({journal_}, checking); }
  // Does so from several journals; those that are not there are left out.
  void read_journals(const std::vector<std::string>& names, const Checking& checking);
  // Replaces the journal by the lines of the finished pieces, so that no new line follows a torn one.
  void open_journal();
  void put(const Piece& piece);
  // Ends and sorts the journal.
  void close();
  // Writes the description of the job as it is now, if it is not there yet.
  void update_description() const;

 private:
  void update(std::string_view name, const std::string& text) const;

  std::string path_;
  const StoredJob& job_;
  std::string journal_;
  Entries finished_;
  bool is_sorted_ = true;  // true if later pieces followed earlier ones
  std::unique_ptr<exporting::AppendFile> lines_;
};

}  // namespace ombre::stores
