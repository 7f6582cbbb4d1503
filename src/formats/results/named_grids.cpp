#include "formats/results/named_grids.h"

#include <filesystem>
#include <map>

#include "base/text/text.h"

namespace ombre::formats {
namespace {

constexpr std::string_view blanks = " \t\r\n";

// Returns the text of an attribute in a tag; empty if it has none.
std::string attribute_in(std::string_view tag, std::string_view name) {
  for (size_t at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
    if (at == 0 || blanks.find(tag[at - 1]) == std::string_view::npos) continue;
    std::string_view rest = trim(tag.substr(at + name.size()));
    if (!rest.starts_with('=')) continue;
    rest = trim(rest.substr(1));
    if (rest.empty()) return "";
    return std::string(rest.substr(1, rest.find(rest.front(), 1) - 1));
  }
  return "";
}

// Returns the tags of an element. The files are searched without building a tree of elements: the names are needed in
// builds without XML, too, where bundles contain them.
std::vector<std::string_view> tags_of(std::string_view bytes, std::string_view element) {
  std::vector<std::string_view> tags;
  for (size_t at = bytes.find(element); at != std::string_view::npos; at = bytes.find(element, at + 1))
    tags.push_back(bytes.substr(at, bytes.find('>', at) - at));
  return tags;
}

bool begins_with(std::string_view bytes, std::string_view type) {
  constexpr size_t most_bytes_before = 4096;
  const std::string_view begin = bytes.substr(0, most_bytes_before);
  const size_t root = begin.find("<VTKFile");
  if (root == std::string_view::npos) return false;
  return attribute_in(begin.substr(root, begin.find('>', root) - root), "type") == type;
}

}  // namespace

bool is_pvd(std::string_view bytes) { return begins_with(bytes, "Collection"); }
bool is_pvtu(std::string_view bytes) { return begins_with(bytes, "PUnstructuredGrid"); }

std::vector<std::string> files_named_in_pvd(std::string_view bytes, uint64_t step) {
  std::map<double, std::vector<std::string>> steps;
  for (const std::string_view tag : tags_of(bytes, "<DataSet"))
    if (std::string name = attribute_in(tag, "file"); !name.empty())
      steps[parse_number(attribute_in(tag, "timestep")).value_or(0)].push_back(std::move(name));
  if (steps.empty() || step > steps.size()) return {};
  return std::next(steps.begin(), static_cast<ptrdiff_t>(step == 0 ? steps.size() - 1 : step - 1))->second;
}

std::vector<std::string> files_named_in_pvtu(std::string_view bytes, uint64_t) {
  std::vector<std::string> names;
  for (const std::string_view tag : tags_of(bytes, "<Piece"))
    if (std::string name = attribute_in(tag, "Source"); !name.empty()) names.push_back(std::move(name));
  return names;
}

std::string name_beside(const std::string& written, const std::string& name) {
  if (written.empty()) return name;
  return (std::filesystem::path(written).parent_path() / name).lexically_normal().string();
}

}  // namespace ombre::formats
