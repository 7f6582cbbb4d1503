// Grids of numbers as field sources.
#pragma once

#include <functional>
#include <string>

#include "formats/volumes/volume.h"
#include "program/field_source.h"

namespace ombre::importing {

struct VolumeSource {
  program::SourceField source;
  Interval range;  // range of all values
  // Returns a box that contains all places within the grid at which a channel may have a value of the interval.
  std::function<Box(int channel, Interval values)> places;
  size_t bytes = 0;
};

// Returns the source of a grid. Its space is that of voxel indices: voxel (i, j, k) has its centre at that point.
// Channels:
//   "value"    trilinear interpolation between centres
//   "nearest"  value of the nearest voxel; half way between two, that of the one with the greater index
//   "cubic"    cubic convolution along each axis, which has a continuous slope and interpolates the voxels
//              (R. G. Keys, Cubic convolution interpolation for digital image processing, 1981, a = -1/2: Catmull-Rom
//              splines); beyond the grid it continues with the outermost values
//   "cubic_x", "cubic_y", "cubic_z"  derivatives of "cubic" along the axes of the grid, per voxel
// Beyond the grid, values are those of its boundary. On lattices whose points are centres, the rows are copies.
VolumeSource make_volume_source(std::string name, formats::VoxelVolume volume, Hash content);

}  // namespace ombre::importing
