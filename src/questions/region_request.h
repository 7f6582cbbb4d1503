// How a design is to be cut into regions, and how finely: what its surfaces and its outlines have in common.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/math/pitch.h"
#include "questions/partition_program.h"
#include "voxel/lattice.h"

namespace ombre::compile {

// How many bands a value is cut into, or where; of a material or an attribute, or of the material that varies most.
struct BandRequest {
  int count = 4;                     // of equal width: of fractions from 0 to 1, of attributes from least to greatest
  std::vector<double> borders = {};  // instead, if there are any
  std::string of = {};               // empty: the fraction that varies most
};

struct RegionRequest {
  bool by_material = false;            // a region for each material
  bool by_part = false;                // or for each part that has a name
  std::optional<BandRequest> bands;    // or for each band; else one for all
  std::vector<BandRequest> crossed;    // further values, whose bands are crossed with those
  std::optional<double> tolerance_mm;  // else a thousandth of the longest side, rounded; mesh_job.h may take more
  std::optional<double> cell_mm;       // else cells_of_tolerance times the tolerance
};
constexpr double cells_of_tolerance = 4;
// How near to their solids triangles of CAD files are, in tolerances. Those of two solids that touch are as far apart
// in places, and what lies between must not count.
constexpr double triangles_of_tolerance = 0.1;

struct Fineness {
  double tolerance_mm = 0;
  Pitch cell;
};

// Nothing, and diagnostics, when there would be too many cells.
std::optional<Fineness> choose_fineness(const design::Design& design, const Box& box, const RegionRequest& request,
                                        Diagnostics& diagnostics);

// With voxels that are fine enough for surfaces of this tolerance.
design::Design for_tolerance(const design::Design& design, double tolerance_mm);

// Of the whole design, or of `shape`, a part of it. Nothing, and diagnostics, when the design cannot be cut so.
std::optional<RegionProgram> build_regions(const design::Design& design, const Box& box, const RegionRequest& request,
                                           Diagnostics& diagnostics, const design::NodePtr& shape = nullptr);

// Corners of cells over the box, with void around it.
voxel::Lattice corners_over(const Box& box, Pitch cell);

// Nothing is printed there.
bool is_void(const Region& region);

// Of region 1 and so on: the material's, or the mean of what is mixed there.
std::vector<design::Rgba> region_colours(const design::Design& design, const RegionProgram& program, const Box& box,
                                         Diagnostics& diagnostics);

}  // namespace ombre::compile
