// Keeps a share of a job's pieces in a folder in which other processes work on other shares.
#include "stores/shard_store.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "base/text/error.h"

namespace ombre::stores {
namespace {

void refuse_foreign_files(const std::string& path, const std::vector<std::string>& names, const JobWords& words) {
  const auto is_own = [&](const std::string& name) {
    return is_of_shard(without_part(name)) || without_part(name) == words.description_file;
  };
  const auto foreign = std::ranges::find_if_not(names, is_own);
  if (foreign == names.end()) return;
  throw Error(
      Code::exists,
      path + " is not empty, it holds for example " + *foreign + ", and no " + words.kind + "; choose another folder",
      {{"file", path}});
}

}  // namespace

ShardStore::ShardStore(std::string path, const StoredJob& job, const Shard& shard, const Checking& checking)
    : folder_(std::move(path), job, shard.journal()) {
  make_folder(folder_.path(), job.words());
  folder_lock_ = std::make_unique<FolderLock>(folder_.path(), FolderLock::Kind::shared);
  shard_lock_ = std::make_unique<FileLock>(folder_.file(shard.lock()));
  // The names are read before the description is looked for. Another shard writes its description before its pieces, so
  // where there is no description these names are not of pieces.
  const std::vector<std::string> names = names_in(folder_.path());
  if (folder_.holds(job.words().description_file)) {
    folder_.check_description();
  } else {
    refuse_foreign_files(folder_.path(), names, job.words());
    begin_job(job, shard);
  }
  folder_.read_journal(checking);
  folder_.open_journal();
}

// Writes the description under a name of this shard, since other shards may write the same description.
void ShardStore::begin_job(const StoredJob& job, const Shard& shard) const {
  const std::string& description_file = job.words().description_file;
  exporting::write_file(folder_.file(shard.description()), job.description({}), exporting::Durability::flushed);
  if (std::rename(folder_.file(shard.description()).c_str(), folder_.file(description_file).c_str()) != 0)
    throw exporting::write_error(folder_.file(description_file), errno);
}

}  // namespace ombre::stores
