// The shares of a job as ranges of its pieces, in plans.
#pragma once

#include <vector>

#include "base/text/record.h"
#include "stores/gather.h"

namespace ombre::jobs {

// Reads [[0, 25], [25, 60], ...], ranges that follow one another. Reports what is wrong with them.
std::vector<stores::PieceRange> read_shard_ranges(const Data& data, const MemberReader& reader);

}  // namespace ombre::jobs
