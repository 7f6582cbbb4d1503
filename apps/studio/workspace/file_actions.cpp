#include "studio/workspace/file_actions.h"

#include <array>
#include <ctime>

#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "studio/workspace/preset_files.h"
#include "studio/workspace/studio_messages.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

fs::path existing(const Workspace& workspace, const std::string& name) {
  fs::path file = workspace.path(name);
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored) && !fs::is_directory(file, ignored))
    throw RequestError("gone", "there is no file " + name);
  return file;
}

// Returns the path of a file that does not exist yet, and makes its folder.
fs::path new_place(const Workspace& workspace, const std::string& name) {
  fs::path file = workspace.path(name);
  std::error_code error;
  if (fs::symlink_status(file, error).type() != fs::file_type::not_found)
    throw RequestError("exists", name + " is there already; choose another name");
  fs::create_directories(file.parent_path(), error);
  return file;
}

void check(const std::error_code& error, const fs::path& file) {
  if (error)
    throw Error(Code::cannot_write, "cannot write " + file.string() + ": " + error.message(),
                {{"file", file.string()}});
}

// A name without an ending, or with another one, would make another kind of file of it.
void check_ending(const std::string& from, const std::string& to) {
  if (ending_of(from) != ending_of(to))
    throw RequestError("name", to + " ends in another way than " + from + "; the ending says what the file is");
}

// Does the same with the presets beside a design, if it has some and the new place is free.
void with_presets(const Workspace& workspace, const std::string& from, const std::string& to,
                  const std::function<void(const fs::path&, const fs::path&)>& act) {
  if (!is_design_name(from)) return;
  const fs::path old = workspace.path(presets_file_of(from)), made = workspace.path(presets_file_of(to));
  std::error_code ignored;
  if (fs::is_regular_file(old, ignored) && is_presets_file(old) && !fs::exists(made, ignored)) act(old, made);
}

std::string time_text() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::localtime_r(&now, &parts);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d_%H%M%S", &parts)};
}

// Returns the places of a file that exists and of one that does not yet. Throws Error.
std::pair<fs::path, fs::path> old_and_new(const Workspace& workspace, const std::string& from, const std::string& to) {
  const fs::path file = existing(workspace, from);
  check_ending(from, to);
  return {file, new_place(workspace, to)};
}

void move_entry(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  check(error, to);
}

void copy_entry(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy(from, to, error);
  check(error, to);
}

}  // namespace

void rename_file(const Workspace& workspace, const std::string& from, const std::string& to) {
  const auto [file, place] = old_and_new(workspace, from, to);
  with_presets(workspace, from, to, move_entry);
  move_entry(file, place);
}

void duplicate_file(const Workspace& workspace, const std::string& from, const std::string& to) {
  const auto [file, place] = old_and_new(workspace, from, to);
  copy_entry(file, place);
  with_presets(workspace, from, to, copy_entry);
}

void make_folder(const Workspace& workspace, const std::string& name) {
  const fs::path place = new_place(workspace, name);
  std::error_code error;
  fs::create_directories(place, error);
  check(error, place);
}

std::string delete_file(const Workspace& workspace, const std::string& name) {
  const fs::path file = existing(workspace, name), trash = workspace.root() / trash_folder;
  std::error_code error;
  fs::create_directories(trash, error);
  check(error, trash);
  const std::string wanted = time_text() + "_" + fs::path(name).filename().string();
  fs::path place = trash / wanted;
  for (int n = 2; fs::exists(place); ++n) place = trash / (std::to_string(n) + "_" + wanted);
  fs::rename(file, place, error);
  check(error, place);
  return place.string();
}

}  // namespace ombre::studio
