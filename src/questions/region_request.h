// Decides how a design is cut into regions, and how finely, for surfaces and outlines.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/math/pitch.h"
#include "questions/partition_program.h"
#include "voxel/lattice.h"

namespace ombre::compile {

// A request for bands of a material's fraction or of an attribute, by their count or their borders.
struct BandRequest {
  int count = 4;  // bands of equal width: fractions go from 0 to 1, attributes from least to greatest
  std::vector<double> borders = {};  // used instead of `count` if not empty
  std::string of = {};               // material or attribute; empty: the fraction that varies most
  double within = 0;                 // if not 0, used instead of `count`: as few bands as have their middle this near
};

// Returns the least number of bands of equal width over a range whose values are within a distance of their middles.
int fewest_bands(Interval range, double within);

struct RegionRequest {
  bool by_material = false;            // make a region for each material
  bool by_part = false;                // make a region for each part that has a name
  std::optional<BandRequest> bands;    // make a region for each band; without any of these there is one region
  std::vector<BandRequest> crossed;    // further values, whose bands are crossed with `bands`
  std::optional<double> tolerance_mm;  // default: a thousandth of the longest side, rounded; mesh_job.h may take more
  std::optional<double> cell_mm;       // default: cells_of_tolerance times the tolerance
};
constexpr double cells_of_tolerance = 4;
// Distance between the triangles of CAD files and their solids, in tolerances. It is small, since triangles of two
// solids that touch are this far apart in places, and the gaps must not count.
constexpr double triangles_of_tolerance = 0.1;

struct Fineness {
  double tolerance_mm = 0;
  Pitch cell;
};

// Returns nothing, and adds diagnostics, when there would be too many cells.
std::optional<Fineness> choose_fineness(const design::Design& design, const Box& box, const RegionRequest& request,
                                        Diagnostics& diagnostics);

// Returns the design for a job whose voxels are fine enough for surfaces of this tolerance.
design::Design for_tolerance(const design::Design& design, double tolerance_mm);

// Cuts the whole design, or its part `shape`, into regions. Returns nothing, and adds diagnostics, when that is not
// possible.
std::optional<RegionProgram> build_regions(const design::Design& design, const Box& box, const RegionRequest& request,
                                           Diagnostics& diagnostics, const design::NodePtr& shape = nullptr);

// Returns the corners of cells that cover the box, with void around it.
voxel::Lattice corners_over(const Box& box, Pitch cell);

// True if nothing is printed in the region.
bool is_void(const Region& region);

// Returns the colours of regions from region 1 on: the colour of the material, or the mean of the mixture there.
std::vector<design::Rgba> region_colours(const design::Design& design, const RegionProgram& program, const Box& box,
                                         Diagnostics& diagnostics);

}  // namespace ombre::compile
