// Draws a picture of the three planes in the middle of a volume.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/volumes/volume.h"

namespace ombre::jobs {

struct PlanesPicture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;  // rows from the top
};

// Draws the planes side by side: the first axis to the right and the second up, the first and the third, the second and
// the third. Shades of grey go from the number that 0.5 % of the voxels are below to the one that 0.5 % are above.
// Pixels are squares in mm, if the volume states its lengths.
PlanesPicture draw_planes(const formats::VoxelVolume& volume);

}  // namespace ombre::jobs
