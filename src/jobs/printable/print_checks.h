// Checks whether a process can make the voxels of a job.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jobs/printable/check_rule.h"
#include "jobs/slice/slice_request.h"

namespace ombre::compile {

struct CheckLimits {
  std::optional<voxel::SmallestFeature> details;  // walls and gaps
  std::vector<voxel::ForbiddenNeighbour> neighbours;
  bool each_material = false;                   // looks at the walls of each material by itself, too
  std::optional<double> overhang_degrees = {};  // from the vertical: layers may reach so far beyond those below them
  bool is_vat = false;                          // layers are made in a bath of resin
  std::string support = {};                     // the material that is removed after printing
};

// Returns the checks of a job. Rules about materials that the job does not have are left out.
std::vector<PrintCheck> print_checks(const CheckLimits& limits, const Sampling& sampling);

// Returns the number of the material in the job; 0 if it has none of this name.
MaterialId id_of(const Sampling& sampling, const std::string& name);

// Returns layers [begin, end) of the solid without the material of this number, whose flags are there; 0: none.
BitLayers solid_without(const SolidLayers& layers, MaterialId support, int64_t begin, int64_t end);

// Returns those voxels of layers [begin, end) of a region that no ball of this diameter inside the region reaches. The
// rounding of edges and corners of at least a right angle is no such place.
BitLayers thin_places(const BitLayers& region, double diameter_mm, Vec3 voxel_mm, int64_t begin, int64_t end);
int64_t reach_of_thin_places(double diameter_mm, Vec3 voxel_mm);

}  // namespace ombre::compile
