// The journal of a job: one line of JSON for each finished layer.
#include "jobs/slice/job_journal.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text/json.h"
#include "base/text/text.h"

namespace ombre::compile {
namespace {

constexpr double largest_exact = 9007199254740992.0;  // 2^53

// Returns a whole number, 0 or more; sets the flag to false if it is none.
uint64_t whole(const Data* data, bool& good) {
  const double* number = data ? data->number() : nullptr;
  good = good && number && *number >= 0 && *number <= largest_exact && *number == std::floor(*number);
  return good ? static_cast<uint64_t>(*number) : 0;
}

std::string text(const Data* data, bool& good) {
  good = good && data && data->string();
  return good ? *data->string() : "";
}

std::vector<uint64_t> wholes(const Data* data, bool& good) {
  std::vector<uint64_t> values;
  good = good && data && data->list();
  if (!good) return values;
  for (const Data& element : *data->list()) values.push_back(whole(&element, good));
  return values;
}

std::vector<JournalFile> file_list(const Data* data, bool& good) {
  std::vector<JournalFile> files;
  good = good && data && data->list();
  if (!good) return files;
  for (const Data& file : *data->list())
    files.push_back({text(file.find("file"), good), whole(file.find("bytes"), good), text(file.find("hash"), good)});
  return files;
}

// Calls use(line) for each line. A last line without its end was torn, and is skipped.
template <class Use>
void for_each_line(std::string_view text, const Use& use) {
  for (size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    use(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
}

std::optional<Data> parse_line(std::string_view line) {
  Diagnostics ignored;
  return parse_json(make_source("journal", std::string(line)), ignored);
}

}  // namespace

bool JournalEntry::is_empty() const {
  return std::all_of(voxels.begin(), voxels.end(), [](uint64_t count) { return count == 0; });
}

std::string to_line(const JournalEntry& entry) {
  const auto number = [](auto value) { return Data(static_cast<double>(value)); };
  DataList files, voxels, checks;
  for (const JournalFile& file : entry.files)
    files.emplace_back(DataMembers{{"file", file.name}, {"bytes", number(file.bytes)}, {"hash", file.hash}});
  for (const uint64_t count : entry.voxels) voxels.push_back(number(count));
  for (size_t i = 0; i < entry.checks.size(); ++i) {
    const voxel::CheckHits& hits = entry.checks[i];
    if (hits.count == 0) continue;
    checks.emplace_back(
        DataList{number(i), number(hits.count), number(hits.first[0]), number(hits.first[1]), number(hits.first[2])});
  }
  DataMembers line{{"layer", number(entry.layer)}, {"files", files}, {"voxels", voxels}};
  if (!checks.empty()) line.emplace_back("checks", checks);  // [check, voxels, i, j, k] of the first
  return print_json_line(line) + '\n';
}

std::optional<JournalEntry> parse_entry(std::string_view line, size_t material_count, size_t check_count) {
  const std::optional<Data> data = parse_line(line);
  if (!data) return std::nullopt;
  bool good = true;
  JournalEntry entry;
  entry.layer = static_cast<int64_t>(whole(data->find("layer"), good));
  entry.files = file_list(data->find("files"), good);
  entry.voxels = wholes(data->find("voxels"), good);
  entry.checks.resize(check_count);
  if (const Data* checks = data->find("checks"); checks && checks->list()) {
    for (const Data& check : *checks->list()) {
      const std::vector<uint64_t> values = wholes(&check, good);
      if (!good || values.size() != 5 || values[0] >= check_count) return std::nullopt;
      voxel::CheckHits& hits = entry.checks[values[0]];
      hits.count = values[1];
      for (size_t axis = 0; axis < 3; ++axis) hits.first[axis] = static_cast<int64_t>(values[2 + axis]);
    }
  }
  if (!good || entry.voxels.size() != material_count) return std::nullopt;
  return entry;
}

std::vector<JournalEntry> parse_journal(std::string_view text, size_t material_count, size_t check_count) {
  std::map<int64_t, JournalEntry> by_layer;
  for_each_line(text, [&](std::string_view line) {
    if (auto entry = parse_entry(line, material_count, check_count)) by_layer[entry->layer] = std::move(*entry);
  });
  std::vector<JournalEntry> entries;
  entries.reserve(by_layer.size());
  for (auto& [layer, entry] : by_layer) entries.push_back(std::move(entry));
  return entries;
}

std::vector<std::string> journal_files(std::string_view text) {
  std::vector<std::string> files;
  for_each_line(text, [&](std::string_view line) {
    const std::optional<Data> data = parse_line(line);
    bool good = data.has_value();
    if (!good) return;
    for (JournalFile& file : file_list(data->find("files"), good)) files.push_back(std::move(file.name));
  });
  return files;
}

}  // namespace ombre::compile
