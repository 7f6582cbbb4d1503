#include "studio/workspace/downloads.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <vector>

#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "formats/containers/zip_archive.h"
#include "studio/workspace/guard.h"
#include "studio/workspace/studio_messages.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

constexpr size_t most_files = 200'000;
constexpr uint64_t piece_bytes = 1 << 20;

struct Member {
  fs::path path;
  uint64_t bytes = 0;
};

std::vector<Member> files_in(const fs::path& folder) {
  std::vector<Member> found;
  std::error_code error;
  fs::recursive_directory_iterator files(folder, fs::directory_options::skip_permission_denied, error);
  for (const fs::recursive_directory_iterator end; !error && files != end; files.increment(error)) {
    const bool is_hidden = files->path().filename().string().starts_with('.');
    std::error_code ignored;
    if (is_hidden && files->is_directory(ignored)) files.disable_recursion_pending();
    if (is_hidden || files->is_symlink(ignored) || !files->is_regular_file(ignored)) continue;
    found.push_back({files->path(), files->file_size(ignored)});
    if (found.size() > most_files) throw RequestError("size", "the folder has too many files for one archive");
  }
  std::ranges::sort(found, {}, &Member::path);
  return found;
}

bool is_packed_already(const fs::path& path) {
  const std::string ending = ending_of(path);
  return ending == ".png" || ending == ".3mf" || ending == ".gz" || ending == ".zip" || ending == ".sl1" ||
         ending == ".ombre";
}

void append_piece(std::string& bytes, const fs::path& path, uint64_t from, uint64_t count) {
  std::ifstream file(path, std::ios::binary);
  const size_t before = bytes.size();
  bytes.resize(before + count);
  if (!file.seekg(static_cast<std::streamoff>(from)) ||
      !file.read(bytes.data() + before, static_cast<std::streamsize>(count)))
    throw Error(Code::cannot_read, path.string() + " has changed while it was packed; download it again",
                {{"file", path.string()}});
}

}  // namespace

std::string Downloads::add(Download download) {
  std::string key = random_token();
  const std::lock_guard lock(mutex_);
  waiting_.push_front({key, std::make_shared<const Download>(std::move(download))});
  if (waiting_.size() > most) waiting_.pop_back();
  return key;
}

std::shared_ptr<const Download> Downloads::take(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(waiting_, key, &Waiting::key);
  if (found == waiting_.end()) return nullptr;
  auto download = found->download;
  waiting_.erase(found);
  return download;
}

void zip_folder(const std::string& folder, const std::string& path, const std::function<void(double)>& report) {
  const std::vector<Member> members = files_in(folder);
  if (members.empty()) throw RequestError("gone", "there is no file in " + folder);
  double all = 0, done = 0;
  for (const Member& member : members) all += 2 * static_cast<double>(member.bytes);  // they are measured, then packed
  std::exception_ptr problem;  // the archive's library does not pass exceptions on
  const fs::path top = fs::path(folder).filename();
  std::vector<formats::ZipEntry> entries;
  for (const Member& member : members) {
    const auto piece = [&](std::string& bytes, size_t row) {
      const uint64_t from = row * piece_bytes, count = std::min(piece_bytes, member.bytes - from);
      try {
        append_piece(bytes, member.path, from, count);
        done += static_cast<double>(count);
        report(std::min(done / all, 1.0));
      } catch (...) {
        problem = std::current_exception();
        throw;
      }
    };
    formats::ZipEntry entry;
    entry.name = (top / member.path.lexically_relative(folder)).generic_string();
    entry.is_packed = is_packed_already(member.path);
    entry.bytes.add_rows((member.bytes + piece_bytes - 1) / piece_bytes, piece);
    entries.push_back(std::move(entry));
  }
  try {
    formats::write_zip(path, entries);
  } catch (...) {
    if (problem) std::rethrow_exception(problem);
    throw;
  }
}

}  // namespace ombre::studio
