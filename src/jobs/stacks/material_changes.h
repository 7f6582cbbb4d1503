// Compares two solids, voxel by voxel.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/math/index_box.h"
#include "jobs/stacks/compared_solid.h"

namespace ombre::compile {

struct LayerChanges {
  int64_t layer = 0;
  uint64_t voxels = 0;
};

struct MaterialChanges {
  std::vector<std::string> names;  // void, and all materials of both
  std::vector<formats::Rgba> colours;
  std::map<std::pair<size_t, size_t>, uint64_t> voxels;  // that change, by the numbers of their names before and after
  std::array<uint64_t, 2> inside{};                      // voxels inside of the first and of the second one
  IndexBox box;                                          // of the voxels that change
  std::vector<LayerChanges> layers;                      // that change, the worst one first

  uint64_t lost() const;     // voxels that are void in the second one
  uint64_t gained() const;   // voxels that are void in the first one
  uint64_t changed() const;  // voxels of another material
};

// Compares all layers of the lattice. Materials are the same if they have the same name. Throws Error and Cancelled.
MaterialChanges material_changes(const ComparedSolid& a, const ComparedSolid& b, const voxel::Lattice& lattice,
                                 const CheckWork& work);

// Returns a picture of a layer in the materials of the first one: what is lost is red, what is gained blue, what is of
// another material orange.
std::string picture_of_changes(const ComparedSolid& a, const ComparedSolid& b, const MaterialChanges& changes,
                               const voxel::Lattice& lattice, int64_t layer);

}  // namespace ombre::compile
