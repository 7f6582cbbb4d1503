#include "jobs/common/shard_option.h"

#include <charconv>

namespace ombre::compile {

stores::Shard parse_shard(const std::string& text, const std::string& option) {
  const size_t slash = text.find('/');
  stores::Shard shard{0, 0};
  if (slash != std::string::npos) {
    const char *begin = text.data(), *middle = begin + slash, *end = begin + text.size();
    const bool is_read = std::from_chars(begin, middle, shard.number).ptr == middle &&
                         std::from_chars(middle + 1, end, shard.count).ptr == end;
    if (is_read && shard.number >= 1 && shard.number <= shard.count && shard.count <= stores::most_shards) return shard;
  }
  throw options::WrongValue(spelled::option(option, text) + " is no share of a job; write for example " +
                            spelled::option(option, "3/40") + ", the third of forty");
}

}  // namespace ombre::compile
