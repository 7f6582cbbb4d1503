// Outlines of regions in one layer as closed polygons.
#pragma once

#include <vector>

#include "base/math/vec.h"
#include "base/system/progress.h"
#include "surface/cells/partition.h"
#include "voxel/fields.h"

namespace ombre::surface {

// A closed polygon in mm of at least three points, without a repeated first point; neighbouring points differ.
using Polygon = std::vector<Vec2>;

// The polygons of each region. Counter-clockwise polygons are outer borders and come first; clockwise ones are borders
// of holes.
struct LayerOutline {
  std::vector<std::vector<Polygon>> regions;  // region 1, region 2 and so on
};

// Returns the polygon's area, positive if it is counter-clockwise.
double area_mm2(const Polygon& polygon);
// Returns the area of a region: that of its outer borders less that of its holes.
double area_mm2(const std::vector<Polygon>& polygons);

// Traces outlines by dual contouring in the plane (Ju et al., 2002). Each cell that borders pass through gets a vertex
// where they meet, so corners stay sharp, and borders pass through the points where they cross the edges of cells.
// Neighbouring regions share their points exactly. Features thinner than a cell may be lost.
class Outliner {
 public:
  // Constructs an outliner; layer k is the plane of the corners k, and cells are squares. The outermost corners along x
  // and y count as void. Borders are accurate to the tolerance if it is at least an eighth of a cell and radii are at
  // least four cells.
  Outliner(const Partition& partition, const voxel::Lattice& corners, double tolerance_mm);

  // Returns the outlines in layer k. Thread-safe. Throws Cancelled.
  LayerOutline layer(int64_t k, const StopFlag* stop = nullptr) const;

 private:
  const Partition& partition_;
  voxel::Lattice corners_;
  voxel::FieldEvaluator evaluator_;
  double tolerance_mm_;
};

}  // namespace ombre::surface
