// VTK image data (.vti): XML, with the numbers behind it as they lie in memory.
//
// "VTK XML file formats", The VTK User's Guide, Kitware. Voxels are cells, so that their borders and the grid's corners
// are where they are in the design.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/math/vec.h"

namespace ombre::formats {

// Numbers of all voxels, x fastest, then y, then z; those of one voxel together.
struct VtiArray {
  std::string name;
  bool is_float = true;                 // of 32 bits; else bytes
  std::vector<std::string> components;  // their names; one that is empty for single numbers
  uint64_t bytes_per_voxel() const { return components.size() * (is_float ? 4 : 1); }
};

struct VtiGrid {
  std::array<int64_t, 3> count{};  // voxels along x, y, z
  Vec3 spacing_mm, corner_mm;      // the corner of the first voxel
  std::vector<VtiArray> arrays;
  std::string note;  // for people; it becomes a comment
  uint64_t voxels() const;
};

// All before the first number. Behind it follow, for each array, its length in bytes in eight bytes, low byte first,
// and its numbers; and then the end.
std::string vti_header(const VtiGrid& grid);
std::string vti_end();
// Where an array's numbers begin, from the end of the header.
uint64_t vti_offset(const VtiGrid& grid, size_t array);

}  // namespace ombre::formats
