// One grid of an OpenVDB file as a dense array of voxels.
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
  std::vector<float> values;  // x fastest; booleans are 0 and 1
  int64_t channels = 1;       // values per voxel in the file; 3 for vectors
  Affine space_from_index;    // maps indices of voxels to their centres, in the file's units, which are taken as mm
};

// Reads the box of a grid's active voxels, with a margin of one voxel; beyond, the grid has its background value. An
// empty name means the only grid. For vectors, `channel` is the component from 0, or -1 for their length.
// Throws Error, naming the path, if the file is broken, lacks the grid or channel, or has several grids and none is
// named, if the grid holds no numbers or more than 16 GiB, and in builds without the library. Throws Cancelled once
// `stop`, which may be null, is set.
DenseGrid read_grid(const std::string& path, const std::string& name, int channel, const StopFlag* stop);
// Returns the formats of OpenVDB and NanoVDB.
std::vector<ombre::FileFormat> file_formats();
bool is_vdb(std::string_view bytes);

}  // namespace ombre::vdb
