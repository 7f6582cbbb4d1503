// One grid of an OpenVDB file, all its voxels side by side.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/math/vec.h"
#include "base/system/file_format.h"
#include "base/system/progress.h"

namespace ombre::vdb {

struct DenseGrid {
  std::string name;
  std::array<int64_t, 3> count{};
  std::vector<float> values;  // x fastest; flags are 0 and 1
  int64_t channels = 1;       // of a voxel in the file; 3 of vectors
  Affine space_from_index;    // of voxels' centres, in the units of the file, which are taken as mm
};

// The active voxels of a grid and one around them; beyond, a grid is its background. An empty name: the only grid.
// Of vectors the values are those of a channel, counted from 0, or of -1 their lengths. Throws Error, naming the path:
// when the file is broken, has no such grid or channel, or several grids and none is named, when the grid holds no
// numbers, or more than 16 GiB, and when this was built without the library; Cancelled once `stop`, which may be null,
// is set.
DenseGrid read_grid(const std::string& path, const std::string& name, int channel, const StopFlag* stop);
// Those of OpenVDB and NanoVDB.
std::vector<ombre::FileFormat> file_formats();
bool is_vdb(std::string_view bytes);

}  // namespace ombre::vdb
