// The bytes of the last image rows, with the latest places of short sequences of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "formats/containers/deflate.h"

namespace ombre::formats {

// Deflates smooth rows, whose edges follow the course of the edges above. Places are recorded only where a match or a
// literal begins, which is mostly at edges, so this takes little time.
class ByteHistory {
 public:
  ByteHistory();

  // Forgets all rows, so that the following ones do not repeat them.
  void clear();
  void put_row(const uint8_t* bytes, size_t size, DeflateWriter& out);

 private:
  struct Match {
    size_t length = 0, distance = 0;
  };

  void append(const uint8_t* bytes, size_t size);
  Match find(size_t at);
  size_t common_length(size_t at, size_t there) const;

  std::vector<uint8_t> bytes_;  // the first byte is unused; a word of zeros follows the data
  size_t row_ = 1, end_ = 1;    // range of the newest row
  std::vector<size_t> latest_;  // by hash: the latest place of a sequence of bytes, or 0
};

}  // namespace ombre::formats
