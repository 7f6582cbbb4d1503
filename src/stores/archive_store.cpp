// Keeps the pieces of a job in a zip archive with the files that a folder would have.
#include "stores/archive_store.h"

#include <filesystem>
#include <system_error>

#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "formats/containers/file.h"
#include "formats/containers/zip_archive.h"

namespace ombre::stores {
namespace {

namespace fs = std::filesystem;

std::string free_path(std::string path, FolderUse use) {
  ArchiveStore::refuse_used_file(path, use);
  return path;
}

std::vector<std::string> names_of(const StoredJob& job, const Entries& finished) {
  std::vector<std::string> names{job.words().description_file, journal_file};
  for (const auto& [id, entry] : finished)
    for (const StoredFile& file : entry.files) names.push_back(file.name);
  return names;
}

using FurtherFiles = std::vector<std::pair<std::string, std::string>>;

void write_archive(const std::string& path, const fs::path& folder, const std::vector<std::string>& names,
                   const FurtherFiles& further) {
  std::vector<formats::ZipEntry> entries;
  for (const auto& file : further) {
    entries.push_back({file.first, {}, false});
    entries.back().bytes.add_rows(1, [&file](std::string& bytes, size_t) { bytes += file.second; });
  }
  for (const std::string& name : names) {
    entries.push_back({name, {}, name.ends_with(".png")});
    entries.back().bytes.add_rows(
        1, [file = (folder / name).string()](std::string& bytes, size_t) { bytes += formats::read_file(file); });
  }
  exporting::PendingFile pending(path);
  try {
    formats::write_zip(pending.part(), entries);
  } catch (const std::system_error& error) {
    throw exporting::write_error(path, error.code().value());
  }
  pending.commit();
}

}  // namespace

void ArchiveStore::refuse_used_file(const std::string& path, FolderUse use) {
  std::error_code ignored;
  if (!formats::can_write_zip()) formats::write_zip(path, {});  // throws, and says what is missing
  if (use != FolderUse::replace && fs::exists(path, ignored))
    throw Error(Code::exists,
                path + " exists already; replace it with " + spelled::option("--force") + ", or choose another name",
                {{"file", path}});
  if (fs::is_directory(path, ignored))
    throw Error(Code::cannot_write, path + " is a folder; choose another name", {{"file", path}});
}

ArchiveStore::ArchiveStore(std::string path, const StoredJob& job, FolderUse use, Checking checking)
    : path_(free_path(std::move(path), use)), job_(job), folder_(folder_of(path_), job, use, checking) {}

void ArchiveStore::close() {
  folder_.close();
  if (!job_.is_complete(finished())) return;
  const std::vector<std::string> names = names_of(job_, finished());
  const std::string folder = folder_of(path_);
  write_archive(path_, folder, names, job_.further_files(ending_of(path_), finished()));
  // Files of others stay, and the folder with them.
  std::error_code ignored;
  for (const std::string& name : names) fs::remove(fs::path(folder) / name, ignored);
  fs::remove(folder, ignored);
}

}  // namespace ombre::stores
