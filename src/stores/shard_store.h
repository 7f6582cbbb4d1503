// Keeps a share of a job's pieces in a folder in which other processes work on other shares.
#pragma once

#include <memory>
#include <string>

#include "stores/folder_lock.h"
#include "stores/journal_folder.h"
#include "stores/shard.h"

namespace ombre::stores {

class ShardStore : public Store {
 public:
  // Joins the job in the folder, or begins it, and continues this share of it. Throws Error when the folder cannot be
  // written, holds another job or files of others, or when another run has the folder for itself or does this share.
  // Throws Cancelled when asked to stop meanwhile.
  ShardStore(std::string path, const StoredJob& job, const Shard& shard, const Checking& checking = {});

  // Returns the pieces of this share.
  const Entries& finished() const override { return folder_.finished(); }
  void put(Piece piece) override { folder_.put(piece); }
  // Sorts the journal of this share. The description stays that of an unfinished job.
  void close() override { folder_.close(); }

 private:
  void begin_job(const StoredJob& job, const Shard& shard) const;

  std::unique_ptr<FolderLock> folder_lock_;
  std::unique_ptr<FileLock> shard_lock_;
  JournalFolder folder_;
};

}  // namespace ombre::stores
