// Compares bytes with their neighbours, as bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ombre::formats {

// One bit for each byte of a row.
class EqualBytes {
 public:
  // Sets bit i to whether a[i] == b[i].
  void compare(const uint8_t* a, const uint8_t* b, size_t count);

  size_t size() const { return size_; }
  size_t equal_count() const;
  // Returns the beginning of the first stretch of at least four set bits from `position` on; size() if there is none.
  size_t find_stretch(size_t position) const;
  // Returns the first bit from `position` on that is not set.
  size_t stretch_end(size_t position) const;

 private:
  std::vector<uint64_t> words_;  // followed by a word of zeros
  size_t size_ = 0;
};

}  // namespace ombre::formats
