// What layers are made of, and what is known of them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/math/run.h"
#include "program/program.h"

namespace ombre::voxel {

// What the outputs of a program are. Output 0 is the truth value "inside".
struct MaterialProgram {
  program::Program program;           // without calls
  std::vector<MaterialId> materials;  // outputs 1 .. materials.size() are their fractions, which sum to one
  size_t check_count = 0;             // the outputs after them are 1 where a check fails
};

struct CheckHits {
  uint64_t count = 0;
  std::array<int64_t, 3> first{};  // the least voxel in the order k, j, i; meaningless when count is 0
};

struct LayerResult {
  RunLayer runs;                                // of the whole width and height of the lattice, or of a region's
  std::optional<RunLayer> lower_bytes;          // of shades of 16 bits, whose upper bytes are the runs
  std::array<uint64_t, 256> material_counts{};  // by MaterialId
  std::vector<CheckHits> checks;
};

}  // namespace ombre::voxel
