// Checks whether a process can make the voxels of a job.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "jobs/printable/bit_layer.h"
#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// Layers of a job as flags, with a margin of void around them along x and y.
struct SolidLayers {
  BitLayers solid;
  std::map<MaterialId, BitLayers> of_material;  // of those that checks read
};

// A check finds all connected pieces of its flags, those that void outside the part does not reach, or all but the
// largest.
enum class FoundPieces : uint8_t { all, enclosed, but_largest };

// One check. It flags voxels that the process does not make as they are meant.
struct PrintCheck {
  std::string kind;    // a word for programs: "thin", "gap", "neighbour", "hollow", "bodies"
  std::string text;    // "walls and details thinner than 0.21 mm, which fail"
  std::string remedy;  // what to write instead
  bool is_error = false;
  FoundPieces found = FoundPieces::all;
  int64_t reach = 0;  // how far from a voxel it reads, in voxels
  std::vector<MaterialId> materials = {};
  // Returns the flags of layers [begin, end). The layers that are given reach beyond them.
  std::function<BitLayers(const SolidLayers& layers, int64_t begin, int64_t end)> flags;
};

struct CheckLimits {
  std::optional<voxel::SmallestFeature> details;  // walls and gaps
  std::vector<voxel::ForbiddenNeighbour> neighbours;
  bool each_material = false;  // looks at the walls of each material by itself, too
};

// Returns the checks of a job. Rules about materials that the job does not have are left out.
std::vector<PrintCheck> print_checks(const CheckLimits& limits, const Sampling& sampling);

// Returns those voxels of layers [begin, end) of a region that no ball of this diameter inside the region reaches. The
// rounding of edges and corners of at least a right angle is no such place.
BitLayers thin_places(const BitLayers& region, double diameter_mm, Vec3 voxel_mm, int64_t begin, int64_t end);
int64_t reach_of_thin_places(double diameter_mm, Vec3 voxel_mm);

}  // namespace ombre::compile
