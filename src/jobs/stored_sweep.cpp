#include "jobs/stored_sweep.h"

#include <algorithm>
#include <charconv>

#include "base/text/json.h"
#include "base/text/text.h"
#include "stores/shard.h"

namespace ombre::jobs {
namespace {

constexpr std::string_view case_prefix = "case_";

std::string prefix_of(int64_t number, int64_t count) {
  return std::string(case_prefix).append(stores::piece_number(number, count)).append("_");
}

bool is_case_file(std::string_view name, int64_t count) {
  int64_t number = -1;
  if (name.starts_with(case_prefix))
    std::from_chars(name.data() + case_prefix.size(), name.data() + name.size(), number);
  return number >= 0 && number < count && name.starts_with(prefix_of(number, count));
}

// Returns a cell of the table, in quotes if it has commas, quotes or line ends.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

std::string cell(const Data* value) {
  if (!value) return "";
  return value->number() ? format_number(*value->number()) : value->string() ? cell(*value->string()) : "";
}

DataList texts(const std::vector<std::string>& values) { return DataList(values.begin(), values.end()); }

// Returns the names of all results, in the order in which the cases give them.
std::vector<std::string> result_names(const stores::Entries& finished) {
  std::vector<std::string> names;
  for (const auto& [number, entry] : finished) {
    const Data record(entry.record);
    const Data* results = record.find("results");
    if (!results || !results->members()) continue;
    for (const auto& [name, value] : *results->members())
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace

const stores::JobWords& sweep_words() {
  static const stores::JobWords words{"sweep", "ombre sweep", "cases", "sweep.json", "case", ""};
  return words;
}

std::string StoredSweep::file_prefix(int64_t number) const { return prefix_of(number, cases_.count()); }

std::string StoredSweep::table(const stores::Entries& finished) const {
  const std::vector<std::string> names = result_names(finished);
  std::vector<std::string> header{"case"};
  for (const Varied& varied : cases_.varied()) header.push_back(cell(varied.name));
  for (const std::string& name : names) header.push_back(cell(name));
  header.emplace_back("failure");
  std::string text = join(header, ",") + "\n";
  for (const auto& [number, entry] : finished) {
    const Data record(entry.record);
    const Data* results = record.find("results");
    std::vector<std::string> row{std::to_string(number)};
    for (const std::string& value : cases_.values(number)) row.push_back(cell(value));
    for (const std::string& name : names) row.push_back(cell(results ? results->find(name) : nullptr));
    row.push_back(cell(record.find("failure")));
    text += join(row, ",") + "\n";
  }
  return text;
}

std::string StoredSweep::description(const stores::Entries& finished) const {
  DataMembers varied;
  for (const Varied& one : cases_.varied()) varied.emplace_back(one.name, texts(one.values));
  return described({{"kind", cases_.job().kind->name},
                    {"varied", std::move(varied)},
                    {"cases", number(cases_.count())},
                    {"status", is_complete(finished) ? "complete" : "unfinished"}});
}

bool StoredSweep::accepts(const stores::Entry& entry) const {
  if (entry.id < 0 || entry.id >= cases_.count()) return false;
  const Data record(entry.record);
  const Data* values = record.find("values");
  const Data* results = record.find("results");
  const Data* failure = record.find("failure");
  if (!values || !(*values == Data(texts(cases_.values(entry.id))))) return false;
  if (!(results && results->members()) && !(failure && failure->string())) return false;
  return std::ranges::all_of(
      entry.files, [&](const stores::StoredFile& file) { return file.name.starts_with(file_prefix(entry.id)); });
}

bool StoredSweep::owns(std::string_view name) const { return is_case_file(name, cases_.count()); }

std::optional<stores::NameTest> StoredSweep::files_of(const Data& description) const {
  const auto count = stores::whole_number(description.find("cases"));
  if (!count || *count > static_cast<uint64_t>(stores::most_shards)) return std::nullopt;
  return [count](std::string_view name) { return is_case_file(name, static_cast<int64_t>(*count)); };
}

}  // namespace ombre::jobs
