// Keeps the pieces of a job as files in a folder: a description of the job, a journal, and the files of each piece.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "stores/folder_lock.h"
#include "stores/folder_use.h"
#include "stores/journal_folder.h"

namespace ombre::stores {

// Throws Error if the folder exists and holds files that this use does not allow: another job, or files of others.
// Further checks of a resumed or replaced job follow once it is planned.
void refuse_used_folder(const std::string& path, FolderUse use, const JobWords& words);

class FolderStore : public Store {
 public:
  // Prepares the folder for the job's pieces, as `use` says. A resumed job takes over what shards have finished, and
  // removes their journals. Throws Error when it cannot be written, holds files that
  // are not the job's, or is in use by another run. Throws Cancelled when asked to stop meanwhile.
  FolderStore(std::string path, const StoredJob& job, FolderUse use, Checking checking = {});

  const Entries& finished() const override { return folder_.finished(); }
  void put(Piece piece) override { folder_.put(piece); }
  // Sorts the journal and brings the description up to date.
  void close() override;
  // Removes the job's files, and the folder if it holds no others. The store is not used again.
  void remove();

 private:
  void remove_old_job();
  void remove_parts() const;
  std::vector<std::string> all_journals() const;
  void remove_books_of_shards() const;
  bool is_bookkeeping(std::string_view name) const;
  Entries entries_in_journal() const;
  void refuse_collisions() const;

  const StoredJob& job_;
  Checking checking_;
  std::unique_ptr<FolderLock> lock_;
  JournalFolder folder_;
};

}  // namespace ombre::stores
