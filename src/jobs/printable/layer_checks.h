// Checks of processes that build each layer on the one below it, or in a bath of resin.
#pragma once

#include "jobs/printable/check_rule.h"

namespace ombre::compile {

// A voxel is supported if a voxel below it lies within the overhang: the nearest sides of both are less than the height
// of a layer times the tangent of the angle apart, along x and y. Neighbours always support each other, and the plate
// supports the lowest layer. An island is a region of a layer, connected by sides of voxels, without a supported voxel.
PrintCheck island_check(double overhang_degrees, Vec3 voxel_mm);
// Finds unsupported voxels that belong to no island.
PrintCheck overhang_check(double overhang_degrees, Vec3 voxel_mm);

// Finds what holds liquid while layers are built.
PrintCheck cup_check();

}  // namespace ombre::compile
