#include "studio/workspace/presets.h"

#include <algorithm>
#include <cmath>

#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/containers/file.h"
#include "studio/workspace/preset_files.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* version_member = "fileFormatVersion";
constexpr const char* known_version = "1";

Data* member(Data& data, std::string_view name) {
  auto* members = std::get_if<DataMembers>(&data.value);
  if (!members) return nullptr;
  const auto found = std::ranges::find(*members, name, &DataMembers::value_type::first);
  return found == members->end() ? nullptr : &found->second;
}

DataMembers& sets_of(Data& file) { return std::get<DataMembers>(member(file, presets_member)->value); }

bool is_of_presets(Data& file) {
  const Data* sets = member(file, presets_member);
  if (!sets || !sets->members()) return false;
  const Data* version = member(file, version_member);
  if (version && *version != Data(known_version) && *version != Data(1.0)) return false;
  return std::ranges::all_of(*sets->members(), [](const auto& set) { return set.second.members() != nullptr; });
}

// Reads the whole content of the file, so that members of other programs stay. If there is no file, the list of presets
// is empty.
Data read_presets(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return DataMembers{{presets_member, DataMembers{}}, {version_member, known_version}};
  if (fs::is_regular_file(path, error) && fs::file_size(path, error) > Presets::most_bytes)
    throw RequestError("size", path.filename().string() + " is too large to be a file of presets");
  Diagnostics ignored;
  auto file = parse_json(make_source(path.string(), formats::read_file(path.string())), ignored);
  if (!file || !is_of_presets(*file))
    throw RequestError("format",
                       path.filename().string() +
                           " is no file of presets, {\"parameterSets\": {...}, \"fileFormatVersion\": \"1\"}, "
                           "and stays as it is; to have presets, give it or the script another name");
  return std::move(*file);
}

void write_presets(const fs::path& path, const Data& file) {
  const std::string text = print_json(file);
  if (text.size() > Presets::most_bytes)
    throw RequestError("size", "the presets would have more than " +
                                   format_bytes(static_cast<double>(Presets::most_bytes)) + "; delete some first");
  exporting::write_file(path.string(), text, exporting::Durability::flushed);
}

// Writes values as OpenSCAD does: texts have no quotes, and lists a space after each comma.
std::string text_of(const Data& value) {
  if (value.string()) return *value.string();
  if (!value.list()) return print_json_line(value);
  std::vector<std::string> items;
  for (const Data& item : *value.list()) items.push_back(print_json_line(item));
  return "[" + join(items, ", ") + "]";
}

DataList describe_presets(Data& file) {
  DataList list;
  for (const auto& [name, set] : sets_of(file)) {
    DataMembers values;
    for (const auto& [variable, value] : *set.members()) values.emplace_back(variable, text_of(value));
    list.emplace_back(DataMembers{{"name", name}, {"values", std::move(values)}});
  }
  return list;
}

void check_name(const std::string& name) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; };
  if (trim(name).empty() || name.size() > Presets::longest_name || std::ranges::any_of(name, is_control))
    throw RequestError("name", "the name of a preset has 1 to " + std::to_string(Presets::longest_name) +
                                   " bytes on one line, \"small\" for example");
}

void check_value(const std::string& variable, const Data& value) {
  const auto is_finite = [](const Data& item) { return item.number() && std::isfinite(*item.number()); };
  const bool is_list = value.list() && std::ranges::all_of(*value.list(), is_finite);
  if (!is_list && !value.string() && !value.boolean() && !is_finite(value))
    throw RequestError(
        "request", "the value of \"" + variable + "\" is to be a number, a text, true or false, or a list of numbers");
}

}  // namespace

DataList Presets::list(const std::string& design) {
  const fs::path path = workspace_.path(presets_file_of(design));
  const std::lock_guard lock(mutex_);
  Data file = read_presets(path);
  return describe_presets(file);
}

DataList Presets::save(const std::string& design, const std::string& name, const DataMembers& values, bool replaces) {
  check_name(name);
  DataMembers texts;
  for (const auto& [variable, value] : values) {
    check_value(variable, value);
    texts.emplace_back(variable, text_of(value));
  }
  const fs::path path = workspace_.path(presets_file_of(design));
  const std::lock_guard lock(mutex_);
  Data file = read_presets(path);
  DataMembers& sets = sets_of(file);
  const auto known = std::ranges::find(sets, name, &DataMembers::value_type::first);
  if (known != sets.end() && !replaces) throw RequestError("exists", "there is a preset \"" + name + "\" already");
  if (known == sets.end() && sets.size() >= most)
    throw RequestError("size", "there are " + std::to_string(most) + " presets already; delete some first");
  if (known == sets.end())
    sets.emplace_back(name, std::move(texts));
  else
    known->second = std::move(texts);
  write_presets(path, file);
  return describe_presets(file);
}

DataList Presets::remove(const std::string& design, const std::string& name) {
  const fs::path path = workspace_.path(presets_file_of(design));
  const std::lock_guard lock(mutex_);
  Data file = read_presets(path);
  const auto is_it = [&](const auto& set) { return set.first == name; };
  if (std::erase_if(sets_of(file), is_it) == 0) throw RequestError("gone", "there is no preset \"" + name + "\"");
  write_presets(path, file);
  return describe_presets(file);
}

}  // namespace ombre::studio
