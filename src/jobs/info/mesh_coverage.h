// Finds how much of a design lies in the meshes of the results that it reads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "load/loaded.h"

namespace ombre::compile {

struct MeshCoverage {
  std::string file;
  std::optional<double> share;  // share of the design's volume; nothing if no sample lies inside
};

// Surveys each mesh whose results the design's mixture, attributes or shape read, and each place that it is moved to,
// by samples on a coarse lattice. Meshes that only parts of a table of many parts read are not found. Returns nothing,
// and adds diagnostics, when the design has no bounds or is too large.
std::optional<std::vector<MeshCoverage>> survey_coverage(const Loaded& loaded, Diagnostics& diagnostics);

}  // namespace ombre::compile
