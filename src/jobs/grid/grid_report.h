// Reports the voxel grids that a job wrote.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ombre::compile {

struct GridReport {
  std::vector<std::string> files;
  uint64_t bytes_written = 0;
  bool has_inside = false;  // false if no voxel's centre is inside the design
  double seconds = 0;
};

}  // namespace ombre::compile
