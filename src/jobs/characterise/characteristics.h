// Finds the density, the surfaces, the topology and the thinnest places of a piece of a design.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "base/text/data.h"
#include "base/text/diagnostic.h"
#include "jobs/characterise/random_cells.h"
#include "jobs/characterise/solid_grid.h"
#include "jobs/characterise/strut_graphs.h"
#include "load/loaded.h"

namespace ombre::compile {

// A value by fine and by coarse samples, extrapolated for errors that go with the square of their size.
struct Measured {
  double value = 0, error = 0;

  static Measured from(double fine, double coarse);
};

struct Characteristics {
  Box box;
  Vec3 voxel_mm;
  Periodic periodic{};
  Measured volume_mm3, surface_mm2, inner_mm2;
  std::map<std::string, Measured> material_mm3, interface_mm2;
  std::array<Spread, 3> sections;  // shares of the box's section
  std::array<std::vector<double>, 3> section_areas_mm2;
  std::array<double, 3> centroid{};
  GridPieces pieces, voids;
  int64_t euler = 0, coarse_euler = 0;
  ThinPlace wall, gap;
  std::vector<RandomCells> random_cells;
  std::vector<LatticeGraph> lattices;

  double box_mm3() const;
  double density() const { return volume_mm3.value / box_mm3(); }
  double density_error() const { return volume_mm3.error / box_mm3(); }
  // 4 V / A of the void.
  double hydraulic_diameter_mm() const;
  bool is_periodic() const { return periodic[0] || periodic[1] || periodic[2]; }
  // The handles of the solid; nothing if its box repeats, where Euler's number alone does not say them.
  std::optional<int64_t> genus() const;

  // The numbers as rows of a table: names with units, and values.
  std::vector<std::pair<std::string, double>> numbers() const;
  DataMembers data() const;
};

struct CharacteriseRequest {
  double voxel_mm = 1;
  std::optional<Box> box;
  Periodic periodic{};
  int threads = 0;
  size_t memory_bytes = 0;
  Progress* progress = nullptr;
  const StopFlag* stop = nullptr;
};

// Finds the characteristics. `options` are those of a job with its usual sampling. Returns nothing, and adds
// diagnostics, if the design is empty, unbounded or too large for such voxels. Throws Cancelled.
std::optional<Characteristics> characteristics_of(const LoadedPtr& loaded, const CharacteriseRequest& request,
                                                  const PlanOptions& options, Diagnostics& diagnostics);

}  // namespace ombre::compile
