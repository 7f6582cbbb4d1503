// Plans a box of the voxels of a job.
#pragma once

#include <optional>

#include "jobs/slice/plan.h"

namespace ombre::compile {

// Returns the voxels that share volume with the box; nothing when none does. Its corners are finite.
std::optional<voxel::TileBox> region_over(const voxel::Lattice& lattice, const Box& box);

// Returns the voxels of a box that an option gives; without a box all voxels. Throws options::WrongValue when the box
// lies outside of the lattice.
voxel::TileBox chosen_region(const std::optional<Box>& box, const voxel::Lattice& lattice);

// Returns the voxels of the region as a job of their own. They have the materials, and layers the names, that they have
// in the whole job.
Plan part_of(Plan plan, const voxel::TileBox& region);

}  // namespace ombre::compile
