// The option that chooses a share of a job.
#pragma once

#include <string>

#include "options/option_values.h"
#include "stores/shard.h"

namespace ombre::compile {

// Reads a share of a job, "3/40". Throws options::WrongValue.
stores::Shard parse_shard(const std::string& text, const std::string& option);
inline constexpr options::Kind<stores::Shard> shard_kind{"share", parse_shard};

}  // namespace ombre::compile
