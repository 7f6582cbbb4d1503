// The journal of a store: one line of JSON for each finished piece of a job.
#include "stores/journal.h"

#include <cmath>

#include "base/text/json.h"

namespace ombre::stores {
namespace {

constexpr double largest_exact = 9007199254740992.0;  // 2^53

std::optional<StoredFile> parse_file(const Data& data) {
  const Data* name = data.find("file");
  const Data* hash = data.find("hash");
  const std::optional<uint64_t> bytes = whole_number(data.find("bytes"));
  if (!name || !name->string() || !hash || !hash->string() || !bytes) return std::nullopt;
  return StoredFile{*name->string(), *bytes, *hash->string()};
}

// Returns nothing for a line that is torn, or that has no such number or no list of files.
std::optional<Entry> parse_line(const std::string& id_name, std::string_view line) {
  Diagnostics ignored;
  const std::optional<Data> data = parse_json(make_source("journal", std::string(line)), ignored);
  if (!data || !data->members()) return std::nullopt;
  const std::optional<uint64_t> id = whole_number(data->find(id_name));
  const Data* files = data->find("files");
  if (!id || !files || !files->list()) return std::nullopt;
  Entry entry;
  entry.id = static_cast<int64_t>(*id);
  for (const Data& element : *files->list()) {
    const std::optional<StoredFile> file = parse_file(element);
    if (!file) return std::nullopt;
    entry.files.push_back(*file);
  }
  for (const auto& member : *data->members())
    if (member.first != id_name && member.first != "files") entry.record.push_back(member);
  return entry;
}

}  // namespace

uint64_t bytes_of(const Entry& entry) {
  uint64_t bytes = 0;
  for (const StoredFile& file : entry.files) bytes += file.bytes;
  return bytes;
}

std::optional<uint64_t> whole_number(const Data* data) {
  const double* number = data ? data->number() : nullptr;
  if (!number || !(*number >= 0 && *number <= largest_exact) || *number != std::floor(*number)) return std::nullopt;
  return static_cast<uint64_t>(*number);
}

std::string to_line(const std::string& id_name, const Entry& entry) {
  DataList files;
  for (const StoredFile& file : entry.files)
    files.emplace_back(DataMembers{{"file", file.name}, {"bytes", number(file.bytes)}, {"hash", file.hash}});
  DataMembers line{{id_name, number(entry.id)}, {"files", files}};
  line.insert(line.end(), entry.record.begin(), entry.record.end());
  return print_json_line(line) + '\n';
}

std::string to_lines(const std::string& id_name, const Entries& entries) {
  std::string text;
  for (const auto& [id, entry] : entries) text += to_line(id_name, entry);
  return text;
}

Entries parse_journal(const std::string& id_name, std::string_view text, const Accepts& accepts) {
  Entries entries;
  for (size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    std::optional<Entry> entry = parse_line(id_name, text.substr(0, end));
    text.remove_prefix(end + 1);
    if (entry && accepts(*entry)) entries.insert_or_assign(entry->id, std::move(*entry));
  }
  return entries;
}

}  // namespace ombre::stores
