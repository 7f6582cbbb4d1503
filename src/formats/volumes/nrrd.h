// The header of NRRD files (version 4, teem.sourceforge.net/nrrd); the numbers follow it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/math/vec.h"

namespace ombre::formats {

// A grid along the axes of space, x fastest; millimetres.
struct NrrdHeader {
  std::string type;                                        // "uint8" or "float"
  std::array<int64_t, 3> count{};                          // along x, y, z
  Vec3 spacing_mm, origin_mm;                              // of the first number's place
  bool is_gzip = false;                                    // what follows, else it is raw, low byte first
  std::vector<std::pair<std::string, std::string>> notes;  // keys and values of our own
};

std::string nrrd_header(const NrrdHeader& header);

}  // namespace ombre::formats
