// Design files (docs/reference/design-file.md) as trees of the published method, so that both programs are given the
// same design.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "node.h"
#include "png_writer.h"

namespace baseline {

using Counts = std::array<int64_t, 3>;  // voxels along x, y and z

struct Scene {
  NodePtr root;
  Box box;                             // what is sampled
  std::vector<std::string> materials;  // the first is void
  std::vector<Colour> colours;         // of the materials
};

// Throws on nodes that the rows of the suite do not need. Meshes become grids of the voxels' greatest length.
Scene read_scene(const std::string& path, const Counts& voxels);

}  // namespace baseline
