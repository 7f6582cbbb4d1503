// Grids of numbers as field sources.
#pragma once

#include <functional>
#include <string>

#include "formats/volumes/volume.h"
#include "program/field_source.h"

namespace ombre::importing {

struct VolumeSource {
  program::SourceField source;
  Interval range;  // of all values
  // Encloses the places, within the voxels, where a channel may have a value of the interval.
  std::function<Box(int channel, Interval values)> places;
  size_t bytes = 0;
};

// The source's space is that of voxel indices: voxel (i, j, k) has its centre there. Channels:
//   "value"    between centres by trilinear interpolation
//   "nearest"  that of the nearest voxel; half way between two, of the one with the greater index
//   "cubic"    between centres by cubic convolution along each axis, whose slope is continuous and which passes through
//              the voxels (R. G. Keys, Cubic convolution interpolation for digital image processing, 1981, a = -1/2:
//              Catmull and Rom's splines); beyond the grid it continues with the values at its side
//   "cubic_x", "cubic_y", "cubic_z"  how fast that grows along the axes of the grid, per voxel
// Beyond the grid they are what they are at its side. On lattices whose points are centres the rows are copies.
VolumeSource make_volume_source(std::string name, formats::VoxelVolume volume, Hash content);

}  // namespace ombre::importing
