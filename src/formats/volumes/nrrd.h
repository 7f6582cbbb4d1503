// Writes the header of NRRD files (version 4, teem.sourceforge.net/nrrd); the numbers follow it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/math/vec.h"

namespace ombre::formats {

// A grid along the axes of space, x fastest, in millimetres.
struct NrrdHeader {
  std::string type;                // "uint8" or "float"
  std::array<int64_t, 3> count{};  // along x, y, z
  Vec3 spacing_mm, origin_mm;      // the origin is the position of the first number
  bool is_gzip = false;            // true if the numbers are compressed; otherwise they are raw and little-endian
  std::vector<std::pair<std::string, std::string>> notes;  // additional keys and values
};

std::string nrrd_header(const NrrdHeader& header);

}  // namespace ombre::formats
