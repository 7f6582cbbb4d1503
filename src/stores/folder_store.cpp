// Keeps the pieces of a job as files in a folder.
#include "stores/folder_store.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/system/named_files.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "stores/shard.h"

namespace ombre::stores {
namespace {

namespace fs = std::filesystem;

void remove_file(const std::string& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw Error(Code::cannot_write, "cannot remove " + path + ": " + error.message(), {{"file", path}});
}

// Returns a test for the files that a journal names, if they have the ending of the job's files.
NameTest files_of(const Entries& journal, const std::string& ending) {
  std::set<std::string, std::less<>> names;
  for (const auto& [id, entry] : journal)
    for (const StoredFile& file : entry.files)
      if (file.name.ends_with(ending)) names.insert(file.name);
  return [names](std::string_view name) { return names.contains(name); };
}

}  // namespace

void refuse_used_folder(const std::string& path, FolderUse use, const JobWords& words) {
  refuse_file(path, words);
  std::error_code ignored;
  if (use == FolderUse::replace || !fs::exists(path, ignored)) return;
  if (fs::exists(fs::path(path) / words.description_file, ignored)) {
    if (use == FolderUse::resume) return;
    throw Error(Code::exists,
                path + " already holds a " + words.kind + "; continue it with " + spelled::option("--resume") +
                    ", replace it with " + spelled::option("--force") + ", or choose another folder",
                {{"file", path}});
  }
  const std::vector<std::string> names = names_in(path);
  // A run that ended before its first piece leaves this.
  const std::string unfinished = words.description_file + std::string(exporting::part_suffix);
  const auto foreign = std::ranges::find_if(names, [&](const std::string& name) { return name != unfinished; });
  if (foreign != names.end())
    throw Error(Code::exists,
                path + " is not empty, it holds for example " + *foreign +
                    "; choose another folder, or write beside what is there with " + spelled::option("--force"),
                {{"file", path}});
}

FolderStore::FolderStore(std::string path, const StoredJob& job, FolderUse use, Checking checking)
    : job_(job), checking_(checking), folder_(std::move(path), job, journal_file) {
  make_folder(folder_.path(), job.words());
  lock_ = std::make_unique<FolderLock>(folder_.path());
  refuse_used_folder(folder_.path(), use, job.words());
  if (use == FolderUse::replace) remove_old_job();
  if (use == FolderUse::resume && folder_.holds(job.words().description_file)) {
    folder_.check_description();
    remove_parts();
    folder_.read_journals(all_journals(), checking_);
  } else {
    refuse_collisions();
  }
  folder_.update_description();
  folder_.open_journal();
  remove_books_of_shards();
}

void FolderStore::close() {
  folder_.close();
  folder_.update_description();
}

void FolderStore::remove() {
  folder_.close();
  remove_old_job();
  std::error_code ignored;  // files of others stay, and the folder with them
  std::filesystem::remove(folder_.path(), ignored);
}

// Removes Ombre's own files, and those that the description names, or the journal if that cannot be read.
void FolderStore::remove_old_job() {
  const std::string& description_file = job_.words().description_file;
  if (!folder_.holds(description_file)) return;
  const std::optional<Data> description = folder_.description();
  const std::optional<NameTest> by_description = description ? job_.files_of(*description) : std::nullopt;
  const Entries journal = by_description ? Entries() : entries_in_journal();
  // A damaged description counts as Ombre's if the journal beside it names pieces.
  if (description ? !job_.is_kind(*description) : journal.empty())
    throw Error(Code::exists,
                folder_.file(description_file) + " was not written by Ombre; move it away, or choose another folder",
                {{"file", folder_.path()}});
  const NameTest is_piece = by_description ? *by_description : files_of(journal, job_.words().file_ending);

  // The old names are checked before anything is removed: remaining files may not be in the new job's way.
  std::vector<std::string> pieces, books;
  for (std::string& name : names_in(folder_.path())) {
    const std::string_view whole = without_part(name);
    if (whole == description_file) continue;
    if (is_bookkeeping(whole))
      books.push_back(std::move(name));
    else if (is_piece(whole))
      pieces.push_back(std::move(name));
    else if (job_.owns(whole))
      folder_.refuse_collision(name);
  }
  run_parallel(pieces.size(), checking_.threads, [&](size_t i) { remove_file(folder_.file(pieces[i])); });
  // The description is removed last, so that until then the folder is recognised as a job.
  books.push_back(description_file + std::string(exporting::part_suffix));
  books.push_back(description_file);
  for (const std::string& name : books) remove_file(folder_.file(name));
}

bool FolderStore::is_bookkeeping(std::string_view name) const {
  return name == job_.words().description_file || name == journal_file || is_of_shard(name);
}

Entries FolderStore::entries_in_journal() const {
  if (!folder_.holds(journal_file)) return {};
  return parse_journal(job_.words().id_name, folder_.read(journal_file), [](const Entry&) { return true; });
}

// Checks that no piece would replace a file that Ombre did not write, whatever the user allowed.
void FolderStore::refuse_collisions() const {
  for (const std::string& name : names_in(folder_.path()))
    if (name == journal_file || job_.owns(without_part(name))) folder_.refuse_collision(name);
}

std::vector<std::string> FolderStore::all_journals() const {
  std::vector<std::string> names{journal_file};
  for (const std::string& name : names_in(folder_.path()))
    if (is_journal_of_shard(name)) names.push_back(name);
  return names;
}

// The journal of this run has the entries of all shards by now.
void FolderStore::remove_books_of_shards() const {
  for (const std::string& name : names_in(folder_.path()))
    if (is_of_shard(name)) remove_file(folder_.file(name));
}

void FolderStore::remove_parts() const {
  for (const std::string& name : names_in(folder_.path())) {
    const std::string_view whole = without_part(name);
    if (whole.size() < name.size() && (is_bookkeeping(whole) || job_.owns(whole))) remove_file(folder_.file(name));
  }
}

}  // namespace ombre::stores
