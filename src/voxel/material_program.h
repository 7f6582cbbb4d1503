// The program that determines the materials of layers, and the resulting layers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/math/run.h"
#include "program/program.h"
#include "voxel/channel.h"

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
  // The channels of the job, over the whole width and height of the lattice or region. Materials are the first one.
  std::vector<ChannelPixels> channels;
  std::vector<CheckHits> checks;

  // The runs of a layer that has materials.
  const RunLayer& materials() const { return std::get<RunLayer>(channels.front()); }
  RunLayer& materials() { return std::get<RunLayer>(channels.front()); }
};

}  // namespace ombre::voxel
