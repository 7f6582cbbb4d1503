// A folder with a journal, and the files of the pieces that the journal names.
#include "stores/journal_folder.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <memory>
#include <system_error>

#include "base/system/hash.h"
#include "base/system/steady_pace.h"
#include "base/system/stopwatch.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "formats/containers/file.h"

namespace ombre::stores {
namespace {

namespace fs = std::filesystem;

bool holds_file(const fs::path& folder, const StoredFile& file) {
  const fs::path path = folder / file.name;
  std::error_code error;
  if (fs::file_size(path, error) != file.bytes || error) return false;
  return hash_bytes(formats::read_file(path.string())).hex() == file.hash;
}

}  // namespace

std::string_view without_part(std::string_view name) {
  if (name.ends_with(exporting::part_suffix)) name.remove_suffix(exporting::part_suffix.size());
  return name;
}

void refuse_file(const std::string& path, const JobWords& words) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_directory(path, error))
    throw Error(Code::cannot_write,
                path + " is a file, and the " + words.pieces + " need a folder; choose another name", {{"file", path}});
}

void make_folder(const std::string& path, const JobWords& words) {
  refuse_file(path, words);
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw exporting::write_error(path, error.value());
}

std::vector<char> are_proven(const std::string& folder, const std::vector<const Entry*>& entries,
                             const Checking& checking) {
  std::vector<char> good(entries.size());  // not vector<bool>: written from several threads
  uint64_t total = 0;
  for (const Entry* entry : entries) total += bytes_of(*entry);
  std::atomic<uint64_t> done{0};
  const Stopwatch watch;
  run_parallel(entries.size(), checking.threads, [&](size_t i) {
    if (checking.stop && checking.stop->requested()) throw Cancelled();
    good[i] = std::ranges::all_of(entries[i]->files, [&](const StoredFile& file) { return holds_file(folder, file); });
    done += bytes_of(*entries[i]);
    if (checking.progress) checking.progress->checking(at_steady_pace(done, total, watch.seconds()));
  });
  return good;
}

JournalFolder::JournalFolder(std::string path, const StoredJob& job, std::string journal)
    : path_(std::move(path)), job_(job), journal_(std::move(journal)) {}

std::string JournalFolder::file(std::string_view name) const { return (fs::path(path_) / name).string(); }

bool JournalFolder::holds(std::string_view name) const {
  std::error_code ignored;
  return fs::exists(file(name), ignored);
}

std::string JournalFolder::read(std::string_view name) const { return formats::read_file(file(name)); }

std::optional<Data> JournalFolder::description() const {
  const std::string& name = job_.words().description_file;
  Diagnostics ignored;
  return parse_json(make_source(file(name), read(name)), ignored);
}

void JournalFolder::check_description() const {
  const std::optional<Data> there = description();
  if (!there || !there->members())
    throw Error(Code::other_job,
                file(job_.words().description_file) + " is damaged, so the job cannot be resumed; replace it with " +
                    spelled::option("--force") + ", or choose another folder",
                {{"file", path_}});
  job_.check_same(path_, *there->members());
}

void JournalFolder::refuse_collision(const std::string& name) const {
  const std::string& kind = job_.words().kind;
  throw Error(Code::exists,
              file(name) + " is not part of a " + kind +
                  ", but a job would write that name; move it away, or choose another folder",
              {{"file", path_}});
}

void JournalFolder::read_journals(const std::vector<std::string>& names, const Checking& checking) {
  const auto accepts = [&](const Entry& entry) { return job_.accepts(entry); };
  std::vector<Entries> journals;
  for (const std::string& name : names)
    if (holds(name)) journals.push_back(parse_journal(job_.words().id_name, read(name), accepts));
  std::vector<const Entry*> entries;
  for (const Entries& journal : journals)
    for (const auto& [id, entry] : journal) entries.push_back(&entry);
  const std::vector<char> good = are_proven(path_, entries, checking);
  for (size_t i = 0; i < entries.size(); ++i)
    if (good[i]) finished_.emplace(entries[i]->id, *entries[i]);
}

void JournalFolder::open_journal() {
  update(journal_, to_lines(job_.words().id_name, finished_));
  lines_ = std::make_unique<exporting::AppendFile>(file(journal_));
}

void JournalFolder::put(const Piece& piece) {
  for (const auto& [name, bytes] : piece.files) exporting::write_file(file(name), bytes);
  Entry entry = entry_of(piece);
  lines_->append(to_line(job_.words().id_name, entry));
  is_sorted_ = is_sorted_ && (finished_.empty() || finished_.rbegin()->first < entry.id);
  finished_.insert_or_assign(entry.id, std::move(entry));
}

void JournalFolder::close() {
  lines_.reset();
  if (!is_sorted_) update(journal_, to_lines(job_.words().id_name, finished_));
}

void JournalFolder::update_description() const { update(job_.words().description_file, job_.description(finished_)); }

void JournalFolder::update(std::string_view name, const std::string& text) const {
  if (holds(name) && read(name) == text) return;
  exporting::write_file(file(name), text, exporting::Durability::flushed);
}

}  // namespace ombre::stores
