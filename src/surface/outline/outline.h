// The regions of a layer as closed polygons.
#pragma once

#include <vector>

#include "base/math/vec.h"
#include "base/system/progress.h"
#include "surface/cells/partition.h"
#include "voxel/fields.h"

namespace ombre::surface {

// Closed, without the first point at the end; at least three points, no two neighbours alike. mm
using Polygon = std::vector<Vec2>;

// Counter-clockwise polygons are outer borders, clockwise ones those of holes; the outer ones go first.
struct LayerOutline {
  std::vector<std::vector<Polygon>> regions;  // region 1 and so on
};

// Positive when counter-clockwise.
double area_mm2(const Polygon& polygon);
// Of a region: outer borders without holes.
double area_mm2(const std::vector<Polygon>& polygons);

// Dual contouring in the plane (Ju et al., 2002): each cell that borders go through gets a vertex where they meet, so
// corners stay sharp, and borders run through the points where they cross the cells' edges. Regions that meet share
// their points, bit by bit. What is thinner than a cell may be lost.
class Outliner {
 public:
  // Layer k is the plane of corners k; cells are squares. The outermost corners along x and y count as void. Borders
  // lie within the tolerance where it is an eighth of a cell or more and radii are four cells or more.
  Outliner(const Partition& partition, const voxel::Lattice& corners, double tolerance_mm);

  // Thread-safe. Throws Cancelled.
  LayerOutline layer(int64_t k, const StopFlag* stop = nullptr) const;

 private:
  const Partition& partition_;
  voxel::Lattice corners_;
  voxel::FieldEvaluator evaluator_;
  double tolerance_mm_;
};

}  // namespace ombre::surface
