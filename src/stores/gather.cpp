// Lists the pieces that all shares of a job have finished.
#include "stores/gather.h"

#include <map>

#include "base/system/named_files.h"
#include "stores/shard.h"

namespace ombre::stores {
namespace {

std::vector<PieceRange> gaps_in(const Entries& finished, PieceRange wanted) {
  std::vector<PieceRange> gaps;
  int64_t next = wanted.begin;
  for (auto entry = finished.lower_bound(wanted.begin); entry != finished.end() && entry->first < wanted.end; ++entry) {
    if (next < entry->first) gaps.push_back({next, entry->first});
    next = entry->first + 1;
  }
  if (next < wanted.end) gaps.push_back({next, wanted.end});
  return gaps;
}

}  // namespace

Gathered gather(const std::string& folder, const StoredJob& job, PieceRange wanted, const Checking& checking) {
  const JournalFolder files(folder, job, journal_file);
  files.check_description();
  const auto accepts = [&](const Entry& entry) { return job.accepts(entry); };
  std::vector<std::pair<std::string, Entries>> journals;
  for (const std::string& name : names_in(folder))
    if (name == journal_file || is_journal_of_shard(name))
      journals.emplace_back(name, parse_journal(job.words().id_name, files.read(name), accepts));
  std::vector<const Entry*> entries;
  for (const auto& [name, journal] : journals)
    for (const auto& [id, entry] : journal) entries.push_back(&entry);
  const std::vector<char> good = are_proven(folder, entries, checking);

  Gathered gathered;
  std::map<int64_t, std::vector<std::string>> places;
  size_t i = 0;
  for (const auto& [name, journal] : journals) {
    for (const auto& [id, entry] : journal) {
      if (!good[i++]) continue;
      gathered.finished.emplace(id, entry);
      places[id].push_back(name);
    }
  }
  for (auto& [id, names] : places)
    if (names.size() > 1) gathered.repeated.push_back({id, std::move(names)});
  gathered.gaps = gaps_in(gathered.finished, wanted);
  return gathered;
}

}  // namespace ombre::stores
