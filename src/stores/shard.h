// Shares of a job that several processes do in one folder, and the names of their files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ombre::stores {

inline constexpr int64_t most_shards = 1'000'000;

struct Shard {
  int64_t number = 1, count = 1;  // 1 <= number <= count

  std::string journal() const;      // journal-3-of-40.jsonl
  std::string lock() const;         // journal-3-of-40.lock
  std::string description() const;  // description-3-of-40.json, until it is renamed
};

// True if a file has the name of some shard's journal.
bool is_journal_of_shard(std::string_view name);
// True if a file has a name that some shard writes beside the pieces.
bool is_of_shard(std::string_view name);

}  // namespace ombre::stores
