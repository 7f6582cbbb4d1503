// 128-bit content hashes (XXH3), the same on every machine.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace ombre {

struct Hash {
  uint64_t high = 0, low = 0;

  auto operator<=>(const Hash&) const = default;
  std::string hex() const;  // 32 digits
};

Hash hash_bytes(std::string_view bytes);

}  // namespace ombre
