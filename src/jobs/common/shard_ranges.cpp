#include "jobs/common/shard_ranges.h"

namespace ombre::jobs {

std::vector<stores::PieceRange> read_shard_ranges(const Data& data, const MemberReader& reader) {
  std::vector<stores::PieceRange> shards;
  const DataList* ranges = reader.list(data, "shards");
  if (!ranges) return shards;
  constexpr double most = 9007199254740992;  // 2^53
  for (const Data& range : *ranges) {
    const auto ends = reader.numbers(range, "a share", 2, "[first, end]", {0, most, true});
    if (!ends) return shards;
    const stores::PieceRange read{static_cast<int64_t>((*ends)[0]), static_cast<int64_t>((*ends)[1])};
    if (read.end < read.begin || (!shards.empty() && shards.back().end != read.begin)) {
      reader.fail(range, "a share begins where the one before it ends", "make the plan anew: ombre plan");
      return shards;
    }
    shards.push_back(read);
  }
  if (shards.empty()) reader.fail(data, "a plan has one share at least");
  return shards;
}

}  // namespace ombre::jobs
