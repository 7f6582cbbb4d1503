// Manages the folder of a slice job: job.json, journal.jsonl and the files of each layer.
#include "jobs/slice/job_folder.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include "base/system/assert.h"
#include "base/system/hash.h"
#include "base/system/steady_pace.h"
#include "base/system/stopwatch.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "formats/containers/file.h"
#include "jobs/slice/job_description.h"
#include "jobs/slice/job_lock.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;
using exporting::part_suffix;

// Returns the name of the file that `name` is an unfinished part of, else `name`.
std::string_view without_part(std::string_view name) {
  if (name.ends_with(part_suffix)) name.remove_suffix(part_suffix.size());
  return name;
}

bool is_bookkeeping(std::string_view name) { return name == job_file || name == journal_file; }

std::optional<Data> read_job(const std::string& path) {
  Diagnostics ignored;
  return parse_json(make_source(path, formats::read_file(path)), ignored);
}

bool is_slice_job(const Data& job) {
  const Data* format = job.find("format");
  return format && format->string() && format->string()->starts_with(job_format);
}

// Returns the names of the job's materials, without void.
std::optional<std::vector<std::string>> material_names(const Data* materials) {
  if (!materials || !materials->list() || materials->list()->empty()) return std::nullopt;
  std::vector<std::string> names;
  for (const Data& material : *materials->list()) {
    const Data* name = material.find("name");
    if (!name || !name->string()) return std::nullopt;
    names.push_back(*name->string());
  }
  names.erase(names.begin());
  return names;
}

// Returns the names of the layers' files by a folder's job.json.
std::optional<LayerFiles> layer_files(const std::optional<Data>& job) {
  const Data* images = job ? job->find("images") : nullptr;
  const Data* sampling = job ? job->find("sampling") : nullptr;
  const Data* files = images ? images->find("files") : nullptr;
  const Data* first = images ? images->find("first_index") : nullptr;
  const Data* voxels = sampling ? sampling->find("voxels") : nullptr;
  if (!files || !files->string() || !first || !first->number()) return std::nullopt;
  if (!voxels || !voxels->list() || voxels->list()->size() != 3 || !voxels->list()->back().number())
    return std::nullopt;
  const auto pattern = voxel::NamePattern::parse(*files->string());
  const auto materials = material_names(job->find("materials"));
  const double first_index = *first->number(), count = *voxels->list()->back().number();
  if (!pattern || !materials || std::abs(first_index) > 1e9 || !(count >= 0 && count < 1e9)) return std::nullopt;
  return LayerFiles(*pattern, *materials, static_cast<int64_t>(first_index), static_cast<int64_t>(count));
}

void refuse_file(const std::string& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_directory(path, error))
    throw Error(Code::cannot_write, path + " is a file, and the layers need a folder; choose another name",
                {{"file", path}});
}

// Returns the names in a folder, sorted.
std::vector<std::string> names_in(const std::string& path) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error))
    names.push_back(entry->path().filename().string());
  if (error)
    throw Error(Code::cannot_read, "cannot read the folder " + path + ": " + error.message(), {{"file", path}});
  std::sort(names.begin(), names.end());
  return names;
}

void make_folder(const std::string& path) {
  refuse_file(path);
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw exporting::write_error(path, error.value());
}

uint64_t bytes_of(const JournalEntry& entry) {
  uint64_t bytes = 0;
  for (const JournalFile& file : entry.files) bytes += file.bytes;
  return bytes;
}

void remove_file(const std::string& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw Error(Code::cannot_write, "cannot remove " + path + ": " + error.message(), {{"file", path}});
}

}  // namespace

void refuse_used_folder(const std::string& path, FolderUse use) {
  refuse_file(path);
  std::error_code ignored;
  if (use == FolderUse::replace || !fs::exists(path, ignored)) return;
  if (fs::exists(fs::path(path) / job_file, ignored)) {
    if (use == FolderUse::resume) return;
    throw Error(Code::exists,
                path + " already holds a slice job; continue it with " + spelled::option("--resume") +
                    ", replace it with " + spelled::option("--force") + ", or choose another folder",
                {{"file", path}});
  }
  const std::vector<std::string> names = names_in(path);
  const std::string unfinished = job_file + std::string(part_suffix);  // left by a run without layers
  const auto foreign = std::ranges::find_if(names, [&](const std::string& name) { return name != unfinished; });
  if (foreign != names.end())
    throw Error(Code::exists,
                path + " is not empty, it holds for example " + *foreign +
                    "; choose another folder, or write beside what is there with " + spelled::option("--force"),
                {{"file", path}});
}

JobFolder::JobFolder(std::string path, const SliceRequest& request, FolderUse use, int threads, Progress* progress,
                     const StopFlag* stop)
    : path_(std::move(path)), request_(request), files_(request), threads_(threads), progress_(progress), stop_(stop) {
  make_folder(path_);
  lock_ = std::make_unique<FolderLock>(path_);
  refuse_used_folder(path_, use);
  if (use == FolderUse::replace) remove_old_job();
  if (use == FolderUse::resume && holds(job_file))
    resume();
  else
    start_fresh();
  journal_ = std::make_unique<exporting::AppendFile>(in_folder(journal_file));
}

JobFolder::~JobFolder() = default;

void JobFolder::start_fresh() {
  refuse_collisions();
  exporting::write_file(in_folder(job_file), job_text(false), exporting::Durability::flushed);
  exporting::write_file(in_folder(journal_file), "");
}

void JobFolder::resume() {
  const std::optional<Data> job = read_job(in_folder(job_file));
  if (!job || !job->members())
    throw Error(Code::other_job,
                in_folder(job_file) + " is damaged, so the job cannot be resumed; replace it with " +
                    spelled::option("--force") + ", or choose another folder",
                {{"file", path_}});
  DataMembers there = *job->members();
  std::erase_if(there, [](const auto& member) { return member.first == "status" || member.first == "totals"; });
  if (const std::string difference = first_difference(there, describe_job(request_)); !difference.empty())
    throw Error(Code::other_job,
                path_ + " holds another job: " + difference + "; replace it with " + spelled::option("--force") +
                    ", or choose another folder",
                {{"file", path_}});

  remove_parts();
  if (holds(journal_file)) {
    const std::string text = formats::read_file(in_folder(journal_file));
    keep_proven(parse_journal(text, request_.materials.size(), request_.check_texts.size()));
  }
  // The journal is repaired before the first new line, so that none follows a torn one.
  update(job_file, job_text(is_complete()));
  update(journal_file, journal_text());
}

// Removes Ombre's own files, and those that its job.json names, or the journal if that cannot be read.
void JobFolder::remove_old_job() {
  if (!holds(job_file)) return;
  const std::optional<Data> job = read_job(in_folder(job_file));
  const std::optional<LayerFiles> layers = layer_files(job);
  const NameSet in_journal = layers ? NameSet() : images_in_journal();
  // A damaged job.json counts as Ombre's if the journal beside it names layers.
  if (job ? !is_slice_job(*job) : in_journal.empty())
    throw Error(Code::exists, in_folder(job_file) + " was not written by Ombre; move it away, or choose another folder",
                {{"file", path_}});

  // The old names are checked before anything is removed: remaining files may not be in the new job's way.
  std::vector<std::string> old;
  for (std::string& name : names_in(path_)) {
    const std::string_view whole = without_part(name);
    if (is_bookkeeping(whole)) continue;
    if (layers ? layers->contains(whole) : in_journal.count(whole) > 0)
      old.push_back(std::move(name));
    else if (files_.contains(whole))
      refuse_collision(name);
  }
  run_parallel(old.size(), threads_, [&](size_t i) { remove_file(in_folder(old[i])); });
  // job.json is removed last, so that until then the folder is recognised as a job.
  for (const std::string name : {journal_file, job_file}) {
    remove_file(in_folder(name + std::string(part_suffix)));
    remove_file(in_folder(name));
  }
}

NameSet JobFolder::images_in_journal() const {
  NameSet images;
  if (!holds(journal_file)) return images;
  for (std::string& name : journal_files(formats::read_file(in_folder(journal_file))))
    if (name.ends_with(".png")) images.insert(std::move(name));
  return images;
}

// Checks that no layer would replace a file that Ombre did not write, whatever the user allowed.
void JobFolder::refuse_collisions() const {
  for (const std::string& name : names_in(path_))
    if (name == journal_file || files_.contains(without_part(name))) refuse_collision(name);
}

void JobFolder::refuse_collision(const std::string& name) const {
  throw Error(
      Code::exists,
      in_folder(name) +
          " is not part of a slice job, but a job would write that name; move it away, or choose another folder",
      {{"file", path_}});
}

void JobFolder::remove_parts() const {
  for (const std::string& name : names_in(path_)) {
    const std::string_view whole = without_part(name);
    if (whole.size() < name.size() && (is_bookkeeping(whole) || files_.contains(whole))) remove_file(in_folder(name));
  }
}

void JobFolder::keep_proven(std::vector<JournalEntry> entries) {
  std::vector<char> good(entries.size());  // not vector<bool>: written from several threads
  uint64_t total = 0;
  for (const JournalEntry& entry : entries) total += bytes_of(entry);
  std::atomic<uint64_t> done{0};
  const Stopwatch watch;
  run_parallel(entries.size(), threads_, [&](size_t i) {
    if (stop_ && stop_->requested()) throw Cancelled();
    good[i] = proven(entries[i]);
    done += bytes_of(entries[i]);
    if (progress_) progress_->checking(at_steady_pace(done, total, watch.seconds()));
  });
  for (size_t i = 0; i < entries.size(); ++i)
    if (good[i]) finished_.emplace(entries[i].layer, std::move(entries[i]));
}

bool JobFolder::proven(const JournalEntry& entry) const {
  if (entry.layer >= request_.lattice.count[2]) return false;
  if (entry.files.empty() && entry.is_empty() && request_.drop_empty_layers) return true;
  const std::vector<std::string> names = files_.names(entry.layer);
  const auto is_named = [](const JournalFile& file, const std::string& name) { return file.name == name; };
  return std::equal(entry.files.begin(), entry.files.end(), names.begin(), names.end(), is_named) &&
         std::all_of(entry.files.begin(), entry.files.end(), [&](const JournalFile& file) { return holds(file); });
}

bool JobFolder::holds(const JournalFile& file) const {
  const std::string path = in_folder(file.name);
  std::error_code error;
  if (fs::file_size(path, error) != file.bytes || error) return false;
  return hash_bytes(formats::read_file(path)).hex() == file.hash;
}

void JobFolder::add(JournalEntry entry, const std::vector<std::string>& images) {
  const std::vector<std::string> names = files_.names(entry.layer);
  ASSERT(images.empty() || images.size() == names.size());
  for (size_t i = 0; i < images.size(); ++i) {
    exporting::write_file(in_folder(names[i]), images[i]);
    entry.files.push_back({names[i], images[i].size(), hash_bytes(images[i]).hex()});
  }
  journal_->append(to_line(entry));
  journal_is_sorted_ = journal_is_sorted_ && (finished_.empty() || finished_.rbegin()->first < entry.layer);
  finished_.insert_or_assign(entry.layer, std::move(entry));
}

bool JobFolder::close() {
  journal_.reset();
  if (!journal_is_sorted_) update(journal_file, journal_text());
  if (is_complete()) update(job_file, job_text(true));
  return is_complete();
}

bool JobFolder::is_complete() const { return static_cast<int64_t>(finished_.size()) == request_.lattice.count[2]; }

bool JobFolder::holds(const char* name) const {
  std::error_code ignored;
  return fs::exists(in_folder(name), ignored);
}

std::string JobFolder::in_folder(std::string_view name) const { return (fs::path(path_) / name).string(); }

std::string JobFolder::job_text(bool complete) const {
  DataMembers job = describe_job(request_);
  job.emplace_back("status", complete ? "complete" : "unfinished");
  if (complete) {
    std::vector<JournalEntry> layers;
    for (const auto& [layer, entry] : finished_) layers.push_back(entry);
    job.emplace_back("totals", describe_totals(request_, layers));
  }
  return print_json(job);
}

std::string JobFolder::journal_text() const {
  std::string text;
  for (const auto& [layer, entry] : finished_) text += to_line(entry);
  return text;
}

void JobFolder::update(const char* name, const std::string& text) const {
  const std::string path = in_folder(name);
  if (holds(name) && formats::read_file(path) == text) return;
  exporting::write_file(path, text, exporting::Durability::flushed);
}

}  // namespace ombre::compile
