// Opens the store that a path names: an archive if it ends in .zip, else a folder.
#pragma once

#include <memory>
#include <string>

#include "stores/folder_use.h"
#include "stores/journal_folder.h"
#include "stores/shard.h"

namespace ombre::stores {

bool is_archive(const std::string& path);
// Returns the folder in which the pieces lie until the job is complete.
std::string pieces_folder(const std::string& path);

// Throws Error if this use does not allow what is at the path. Further checks follow once the job is planned.
void refuse_used(const std::string& path, FolderUse use, const JobWords& words);
// Throws as FolderStore and ArchiveStore do.
std::unique_ptr<Store> open_store(const std::string& path, const StoredJob& job, FolderUse use, Checking checking = {});
// Opens the store of a share of the job. Throws as ShardStore does.
std::unique_ptr<Store> open_shard(const std::string& path, const StoredJob& job, const Shard& shard,
                                  Checking checking = {});

}  // namespace ombre::stores
