#include "studio/workspace/workspace.h"

#include <algorithm>

#include "base/system/hash.h"
#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "base/text/utf8.h"
#include "export/output_file.h"
#include "formats/containers/file.h"
#include "studio/workspace/preset_files.h"
#include "studio/workspace/studio_messages.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

constexpr int deepest_folder = 8;

std::string version_of(const std::string& text) { return hash_bytes(text).hex(); }

bool is_within(const fs::path& path, const fs::path& folder) {
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end();
}

bool is_sound_name(const std::string& name) {
  if (name.empty() || name.size() > 1000 || name.front() == '/') return false;
  for (const char c : name)
    if (static_cast<unsigned char>(c) < 32 || c == '\\' || c == 127) return false;
  return std::ranges::none_of(split(name, '/'),
                              [](const std::string& part) { return part.empty() || part.front() == '.'; });
}

bool is_utf8(const std::string& text) {
  for (size_t at = 0; at < text.size();) {
    const size_t bytes = code_point_size(text, at);
    if (bytes == 0) return false;
    at += bytes;
  }
  return true;
}

}  // namespace

bool is_design_name(const std::string& name) {
  const std::string ending = ending_of(name);
  return ending == ".vcad" || ending == ".scad" || ending == ".py" || ending == ".json";
}

Workspace::Workspace(const fs::path& folder) {
  std::error_code error;
  root_ = fs::canonical(folder, error);
  if (error || !fs::is_directory(root_))
    throw Error(Code::cannot_read, folder.string() + " is no folder that the studio could show",
                {{"file", folder.string()}});
}

void Workspace::each_entry(const std::function<bool(const std::string& name, bool is_folder)>& take) const {
  std::error_code error;
  fs::recursive_directory_iterator files(root_, fs::directory_options::skip_permission_denied, error);
  for (const fs::recursive_directory_iterator end; !error && files != end; files.increment(error)) {
    std::error_code ignored;
    const std::string name = files->path().lexically_relative(root_).generic_string();
    const bool is_sound = is_sound_name(name);
    if (!files->is_directory(ignored)) {
      if (is_sound && files->is_regular_file(ignored) && !take(name, false)) return;
      continue;
    }
    const bool is_job = fs::exists(files->path() / "job.json", ignored);
    if (!is_sound || is_job || files.depth() >= deepest_folder || !take(name, true)) files.disable_recursion_pending();
  }
}

std::vector<std::string> Workspace::list() const {
  std::vector<std::string> names;
  each_entry([&](const std::string& name, bool is_folder) {
    if (!is_folder && is_design_name(name) && !is_presets_file(root_ / name)) names.push_back(name);
    return names.size() < most_files;
  });
  std::ranges::sort(names);
  return names;
}

std::vector<Workspace::DataFile> Workspace::list_data() const {
  std::vector<DataFile> found;
  each_entry([&](const std::string& name, bool is_folder) {
    const bool is_series = is_folder && is_dicom_folder(root_ / name);
    const DataKind kind = is_series ? DataKind::scan : is_folder ? DataKind::none : data_kind(name);
    if (kind != DataKind::none) found.push_back({name, kind});
    return !is_series && found.size() < most_files;
  });
  std::ranges::sort(found, {}, &DataFile::name);
  return found;
}

std::vector<std::string> Workspace::list_ending_in(const std::vector<std::string>& endings) const {
  std::vector<std::string> names;
  each_entry([&](const std::string& name, bool is_folder) {
    const auto is_of_name = [lower = to_lower(name)](const std::string& ending) { return lower.ends_with(ending); };
    if (!is_folder && std::ranges::any_of(endings, is_of_name)) names.push_back(name);
    return names.size() < most_files;
  });
  std::ranges::sort(names);
  return names;
}

std::string Workspace::name_of(const fs::path& file) const {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(file, error);
  return error || !is_within(whole, root_) ? "" : whole.lexically_relative(root_).generic_string();
}

fs::path Workspace::path(const std::string& name) const {
  if (!is_sound_name(name))
    throw RequestError("name",
                       "\"" + name + "\" is no name of a file in the folder; write for example parts/knob.vcad");
  std::error_code error;
  fs::path file = fs::weakly_canonical(root_ / name, error);
  if (error || !is_within(file, root_))
    throw RequestError("name", "\"" + name + "\" leads out of the folder that the studio shows");
  return file;
}

fs::path Workspace::plain_path(const std::string& name) const {
  fs::path file = path(name);
  std::error_code ignored;
  const fs::file_type type = fs::status(file, ignored).type();
  if (type != fs::file_type::regular && type != fs::file_type::directory && type != fs::file_type::not_found)
    throw RequestError("name", name + " is a pipe or a device, no file that the studio could read");
  return file;
}

FileText Workspace::read(const std::string& name) {
  const fs::path file = plain_path(name);
  std::error_code error;
  if (fs::is_regular_file(file, error) && fs::file_size(file, error) > most_bytes)
    throw RequestError(
        "size", name + " has more than " + format_bytes(static_cast<double>(most_bytes)) + ", too much to edit here");
  FileText found{formats::read_file(file.string()), ""};
  if (!is_utf8(found.text) || found.text.find('\0') != std::string::npos)
    throw RequestError("text", name + " is no text in UTF-8");
  found.version = version_of(found.text);
  note(name, file, found.version);
  return found;
}

std::variant<std::string, SaveConflict> Workspace::save(const std::string& name, const std::string& text,
                                                        const std::string& version) {
  if (!is_design_name(name))
    throw RequestError("name", name + " ends in none of .vcad, .scad, .py and .json, which the studio edits");
  if (text.size() > most_bytes) throw RequestError("size", "the text is too long to be saved from here");
  const fs::path file = plain_path(name);
  const std::lock_guard lock(save_mutex_);
  if (fs::exists(file)) {
    FileText disk = read(name);
    if (disk.version != version) return SaveConflict{std::move(disk)};
  } else if (!version.empty()) {
    return SaveConflict{};
  }
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  exporting::write_file(file.string(), text, exporting::Durability::flushed);
  std::string made = version_of(text);
  note(name, file, made);
  return made;
}

void Workspace::note(const std::string& name, const fs::path& file, const std::string& version) {
  std::error_code error;
  const std::lock_guard lock(mutex_);
  seen_[name] = {fs::last_write_time(file, error), fs::file_size(file, error), version};
}

std::vector<Workspace::Change> Workspace::changes() {
  std::map<std::string, Seen> before;
  {
    const std::lock_guard lock(mutex_);
    before = seen_;
  }
  std::vector<Change> found;
  for (const auto& [name, seen] : before) {
    std::error_code gone, error;
    const fs::path file = root_ / name;
    const auto time = fs::last_write_time(file, gone);
    if (gone) {
      if (seen.version.empty()) continue;
      note(name, file, "");
      found.push_back({name, ""});
      continue;
    }
    if (time == seen.time && fs::file_size(file, error) == seen.bytes) continue;
    try {
      const FileText disk = read(name);
      if (disk.version != seen.version) found.push_back({name, disk.version});
    } catch (const std::exception&) {  // it is being written or is no longer text: checked again the next time
      continue;
    }
  }
  return found;
}

}  // namespace ombre::studio
