// Rows of voxels as runs: one value, a length.
#pragma once

#include <cstdint>
#include <vector>

namespace ombre {

using MaterialId = uint8_t;  // 0 is void

struct Run {
  MaterialId material = 0;
  uint32_t length = 0;
  bool operator==(const Run&) const = default;
};

// Appends to a row, joining runs of one material.
inline void append_run(std::vector<Run>& row, MaterialId material, uint32_t length) {
  if (length == 0) return;
  if (!row.empty() && row.back().material == material)
    row.back().length += length;
  else
    row.push_back({material, length});
}

// One layer: row j holds runs that add up to `width`. Row 0 has the least y.
struct RunLayer {
  uint32_t width = 0;
  std::vector<std::vector<Run>> rows;
};

}  // namespace ombre
