// 128-bit content hashes (XXH3), identical on every machine.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

namespace ombre {

struct Hash {
  uint64_t high = 0, low = 0;

  friend bool operator==(const Hash&, const Hash&) = default;
  friend bool operator<(const Hash& a, const Hash& b) { return std::tie(a.high, a.low) < std::tie(b.high, b.low); }
  std::string hex() const;  // 32 hexadecimal digits
};

Hash hash_bytes(std::string_view bytes);

}  // namespace ombre
