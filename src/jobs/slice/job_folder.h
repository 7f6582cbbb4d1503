// Manages the folder of a slice job: job.json, journal.jsonl and the files of each layer.
//
// A run can end at any moment and be resumed, by this order of events. job.json is written before the first layer. Each
// file of a layer is written aside and renamed; then the layer's line is added to the journal. Once all layers are
// there, the journal is sorted and job.json gets the totals. A resumed run trusts a line only if the files that it
// names are the layer's, with the sizes and the hashes that it states.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "export/output_file.h"
#include "jobs/slice/job_journal.h"
#include "jobs/slice/layer_files.h"
#include "jobs/slice/slice_request.h"

namespace ombre::compile {

inline constexpr const char* job_file = "job.json";
inline constexpr const char* journal_file = "journal.jsonl";

class FolderLock;

// Throws Error if the folder exists and holds files that this use does not allow: another job, or files of others.
// Further checks of a resumed or replaced job follow once it is planned.
void refuse_used_folder(const std::string& path, FolderUse use);

using NameSet = std::set<std::string, std::less<>>;

class JobFolder {
 public:
  // Prepares the folder for the job's layers, as `use` says. Throws Error when it cannot be written, holds files that
  // are not the job's, or is in use by another run. `threads` threads read existing layers, which takes time for large
  // jobs; `progress` shows it and may be null. Throws Cancelled when asked to stop meanwhile.
  JobFolder(std::string path, const SliceRequest& request, FolderUse use, int threads, Progress* progress,
            const StopFlag* stop);
  ~JobFolder();
  JobFolder(const JobFolder&) = delete;
  JobFolder& operator=(const JobFolder&) = delete;

  // Finished layers of earlier runs and this one, by layer.
  const std::map<int64_t, JournalEntry>& finished() const { return finished_; }

  // Writes the layer's files, then the journal. `entry` has its layer, voxels and checks; without images the layer has
  // no files.
  void add(JournalEntry entry, const std::vector<std::string>& images);

  // Sorts the journal and, if no layer is missing, writes the totals and returns true.
  bool close();

 private:
  void start_fresh();
  void resume();
  void remove_old_job();
  NameSet images_in_journal() const;
  void refuse_collisions() const;
  [[noreturn]] void refuse_collision(const std::string& name) const;
  void remove_parts() const;
  void keep_proven(std::vector<JournalEntry> entries);
  bool proven(const JournalEntry& entry) const;
  bool is_complete() const;
  bool holds(const char* name) const;
  std::string in_folder(std::string_view name) const;
  std::string job_text(bool complete) const;
  std::string journal_text() const;
  void update(const char* name, const std::string& text) const;
  bool holds(const JournalFile& file) const;

  std::string path_;
  const SliceRequest& request_;
  LayerFiles files_;
  int threads_;
  Progress* progress_;
  const StopFlag* stop_;
  std::unique_ptr<FolderLock> lock_;
  std::map<int64_t, JournalEntry> finished_;
  bool journal_is_sorted_ = true;  // true if later layers follow earlier ones
  std::unique_ptr<exporting::AppendFile> journal_;
};

}  // namespace ombre::compile
