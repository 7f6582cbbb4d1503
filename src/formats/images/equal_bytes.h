// Where bytes equal their predecessors, as bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ombre::formats {

// One bit for each byte of a row.
class EqualBytes {
 public:
  // Bit i says whether a[i] == b[i].
  void compare(const uint8_t* a, const uint8_t* b, size_t count);

  size_t size() const { return size_; }
  size_t equal_count() const;
  // Where the first stretch of four set bits or more begins, from `position` on; size() if there is none.
  size_t find_stretch(size_t position) const;
  // The first bit that is not set, from `position` on.
  size_t stretch_end(size_t position) const;

 private:
  std::vector<uint64_t> words_;  // and one of zeros
  size_t size_ = 0;
};

}  // namespace ombre::formats
