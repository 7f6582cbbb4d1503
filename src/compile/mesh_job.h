// From a design to closed surfaces: of the whole, or of its regions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "compile/load.h"
#include "compile/partition_program.h"
#include "surface/bodies.h"

namespace ombre::compile {

// How many bands a value is cut into, or where; of a material or an attribute, or of the material that varies most.
struct BandRequest {
  int count = 4;                // of equal width: of fractions from 0 to 1, of attributes from least to greatest
  std::vector<double> borders;  // instead, if there are any
  std::string of;               // empty: the fraction that varies most
};

struct MeshRequest {
  bool by_material = false;            // a body for each material
  std::optional<BandRequest> bands;    // or for each band; else one for all
  std::optional<double> tolerance_mm;  // else a two-thousandth of the longest side, rounded
  std::optional<double> cell_mm;       // else cells_of_tolerance times the tolerance
  bool join_flat = true;               // cells are joined where the surface is flat
  int threads = 0;
};
constexpr double cells_of_tolerance = 8;

struct RegionBody {
  Region region;
  double share = 0;  // where the region lies among all of the design's, from 0 for the first to 1 for the last
  design::Rgba colour{};
  surface::Body body;
  double volume_mm3 = 0, area_mm2 = 0;
};

struct MeshedDesign {
  std::vector<RegionBody> bodies;  // without those that are empty
  double tolerance_mm = 0, cell_mm = 0;
  std::array<int64_t, 3> cells{};  // along each axis
  surface::ContourReport report;
};

// Nothing, and diagnostics, when the design is empty, or cannot be cut so. Throws Cancelled.
std::optional<MeshedDesign> mesh_design(const Loaded& loaded, const MeshRequest& request, Diagnostics& diagnostics,
                                        Progress* progress = nullptr, const StopFlag* stop = nullptr);

}  // namespace ombre::compile
