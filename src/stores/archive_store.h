// Keeps the pieces of a job in a zip archive with the files that a folder would have.
#pragma once

#include <string>

#include "stores/folder_store.h"

namespace ombre::stores {

// Until the job is complete its pieces lie in a folder beside the archive, PATH.pieces, from which a stopped job is
// resumed.
class ArchiveStore : public Store {
 public:
  // Returns the folder of the pieces.
  static std::string folder_of(const std::string& path) { return path + ".pieces"; }
  // Throws Error if the archive exists and is not to be replaced, or this build cannot write archives.
  static void refuse_used_file(const std::string& path, FolderUse use);

  // Throws as FolderStore does, and as refuse_used_file does.
  ArchiveStore(std::string path, const StoredJob& job, FolderUse use, Checking checking = {});

  const Entries& finished() const override { return folder_.finished(); }
  void put(Piece piece) override { folder_.put(std::move(piece)); }
  // Writes the archive aside and renames it, and removes the folder. If pieces are missing the folder stays.
  void close() override;

 private:
  std::string path_;
  const StoredJob& job_;
  FolderStore folder_;
};

}  // namespace ombre::stores
