// Looks for materials that are too near to each other in a sample of a job's voxels.
#pragma once

#include <functional>
#include <vector>

#include "base/system/progress.h"
#include "voxel/lattice.h"
#include "voxel/material_program.h"

namespace ombre::compile {

// Makes a box of a job's voxels, layer by layer, lowest first.
using BoxOfVoxels = std::function<std::vector<voxel::LayerResult>(const voxel::TileBox& box, const StopFlag* stop)>;

// `material` must be farther than `within_mm` from `near`; 0 is void, and what lies beside the lattice.
struct ApartRule {
  MaterialId material = 0, near = 0;
  double within_mm = 0;
};

struct NearMaterials {
  uint64_t voxels = 0;  // voxels of the material that were looked at
  uint64_t found = 0;   // those with the other one too near along x, y or z
  Vec3 first_mm;        // the centre of the first of them
};

// Looks at boxes that are spread over the lattice and take less than 1 % of its voxels, or some 50,000 of them.
// Distances are those between the faces of voxels. Nothing found does not mean that there is nothing.
NearMaterials find_near_materials(const BoxOfVoxels& voxels, const voxel::Lattice& lattice, const ApartRule& rule,
                                  const StopFlag* stop);

}  // namespace ombre::compile
