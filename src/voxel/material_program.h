// The program that determines the materials of layers, and the resulting layers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/math/run.h"
#include "program/program.h"

namespace ombre::voxel {

// A program and the meaning of its outputs. Output 0 is the truth value "inside".
struct MaterialProgram {
  program::Program program;           // may not hold calls
  std::vector<MaterialId> materials;  // outputs 1 .. materials.size() are their fractions, which sum to one
  size_t check_count = 0;             // the following outputs are 1 where a check fails
};

struct CheckHits {
  uint64_t count = 0;
  std::array<int64_t, 3> first{};  // the first voxel in the order k, j, i; undefined if count is 0
};

struct LayerResult {
  RunLayer runs;                                // over the whole width and height of the lattice or region
  std::optional<RunLayer> lower_bytes;          // lower bytes of 16-bit shades, whose upper bytes are the runs
  std::array<uint64_t, 256> material_counts{};  // indexed by MaterialId
  std::vector<CheckHits> checks;
};

}  // namespace ombre::voxel
