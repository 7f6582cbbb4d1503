// Shares of a job that several processes do in one folder, and the names of their files.
#include "stores/shard.h"

#include <charconv>

namespace ombre::stores {
namespace {

std::string share_of(const Shard& shard) {
  return "-" + std::to_string(shard.number) + "-of-" + std::to_string(shard.count);
}

// Returns true for START-3-of-40END.
bool is_named(std::string_view name, std::string_view start, std::string_view end) {
  if (!name.starts_with(start) || !name.ends_with(end) || name.size() < start.size() + end.size()) return false;
  const std::string_view share = name.substr(start.size(), name.size() - start.size() - end.size());
  const size_t of = share.find("-of-");
  if (!share.starts_with('-') || of == std::string_view::npos || of == 0) return false;
  Shard shard{0, 0};
  std::from_chars(share.data() + 1, share.data() + of, shard.number);
  std::from_chars(share.data() + of + 4, share.data() + share.size(), shard.count);
  return shard.number >= 1 && shard.number <= shard.count && share == share_of(shard);
}

}  // namespace

std::string Shard::journal() const { return "journal" + share_of(*this) + ".jsonl"; }

std::string Shard::lock() const { return "journal" + share_of(*this) + ".lock"; }

std::string Shard::description() const { return "description" + share_of(*this) + ".json"; }

bool is_journal_of_shard(std::string_view name) { return is_named(name, "journal", ".jsonl"); }

bool is_of_shard(std::string_view name) {
  return is_journal_of_shard(name) || is_named(name, "journal", ".lock") || is_named(name, "description", ".json");
}

}  // namespace ombre::stores
