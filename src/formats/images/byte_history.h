// The bytes of the last image rows, and where a few of them stood before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "formats/containers/deflate.h"

namespace ombre::formats {

// Deflates smooth rows, whose edges take the course that edges took before. Only where a match or a literal
// begins it is noted what stands there: mostly at edges, and so little is noted that it takes no time.
class ByteHistory {
 public:
  ByteHistory();

  // What follows repeats nothing that came before.
  void clear();
  void put_row(const uint8_t* bytes, size_t size, DeflateWriter& out);

 private:
  struct Match {
    size_t length = 0, distance = 0;
  };

  void append(const uint8_t* bytes, size_t size);
  Match find(size_t at);
  size_t common_length(size_t at, size_t there) const;

  std::vector<uint8_t> bytes_;  // the first means nothing; and a word of zeros
  size_t row_ = 1, end_ = 1;    // where the newest row begins and ends
  std::vector<size_t> latest_;  // by hash, where some bytes stood at last, or 0
};

}  // namespace ombre::formats
