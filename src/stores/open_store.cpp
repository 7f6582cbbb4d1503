#include "stores/open_store.h"

#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "formats/containers/zip_archive.h"
#include "stores/archive_store.h"
#include "stores/shard_store.h"

namespace ombre::stores {

bool is_archive(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".zip" || ending == ".sl1";
}

std::string pieces_folder(const std::string& path) { return is_archive(path) ? ArchiveStore::folder_of(path) : path; }

void refuse_used(const std::string& path, FolderUse use, const JobWords& words) {
  if (is_archive(path)) ArchiveStore::refuse_used_file(path, use);
  refuse_used_folder(pieces_folder(path), use, words);
}

std::unique_ptr<Store> open_store(const std::string& path, const StoredJob& job, FolderUse use, Checking checking) {
  if (is_archive(path)) return std::make_unique<ArchiveStore>(path, job, use, checking);
  return std::make_unique<FolderStore>(path, job, use, checking);
}

std::unique_ptr<Store> open_shard(const std::string& path, const StoredJob& job, const Shard& shard,
                                  Checking checking) {
  return std::make_unique<ShardStore>(pieces_folder(path), job, shard, checking);
}

}  // namespace ombre::stores
