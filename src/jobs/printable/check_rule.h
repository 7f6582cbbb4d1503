// One check of the voxels of a job.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "jobs/printable/layer_windows.h"

namespace ombre::compile {

// A check finds all connected pieces of its flags, those that void outside the part does not reach, all but the
// largest, or what would hold a liquid that is poured in from above (held_regions.h).
enum class FoundPieces : uint8_t { all, enclosed, but_largest, held };

// One check. It flags voxels that the process does not make as they are meant.
struct PrintCheck {
  std::string kind;    // a word for programs: "thin", "neighbour", "island", ...
  std::string text;    // "walls and details thinner than 0.21 mm, which fail"
  std::string remedy;  // what to write instead
  bool is_error = false;
  FoundPieces found = FoundPieces::all;
  int64_t reach = 0;  // how far from a voxel it reads, in voxels
  std::vector<MaterialId> materials = {};
  // Returns the flags of layers [begin, end). The layers that are given reach beyond them.
  std::function<BitLayers(const SolidLayers& layers, int64_t begin, int64_t end)> flags = {};
};

}  // namespace ombre::compile
