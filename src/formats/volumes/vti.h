// Writes VTK image data (.vti): XML, followed by the numbers as stored in memory.
//
// Source: "VTK XML file formats", The VTK User's Guide, Kitware. Voxels are cells, so that their borders and the grid's
// corners have the same positions as in the design.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/math/vec.h"

namespace ombre::formats {

// The values of all voxels, x fastest, then y, then z; the components of a voxel are interleaved.
struct VtiArray {
  std::string name;
  bool is_float = true;                 // 32-bit floats, else bytes
  std::vector<std::string> components;  // names of components; one empty name for scalars
  uint64_t bytes_per_voxel() const { return components.size() * (is_float ? 4 : 1); }
};

struct VtiGrid {
  std::array<int64_t, 3> count{};  // voxels along x, y, z
  Vec3 spacing_mm, corner_mm;      // corner_mm is the outer corner of the first voxel
  std::vector<VtiArray> arrays;
  std::string note;  // becomes a comment
  uint64_t voxels() const;
};

// Returns everything before the first number. It is followed, for each array, by its size as eight little-endian bytes
// and its numbers, and by vti_end().
std::string vti_header(const VtiGrid& grid);
std::string vti_end();
// Returns the offset of an array's numbers from the end of the header.
uint64_t vti_offset(const VtiGrid& grid, size_t array);

}  // namespace ombre::formats
