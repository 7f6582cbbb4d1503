// Generalised winding numbers: how much of the view from a point a surface fills, gaps and all.
#pragma once

#include "import/surfaces/surface.h"

namespace ombre::importing {

// After Barill, Dickson, Schmidt, Levin and Jacobson, "Fast winding numbers for soups and clouds"
// (2018): clusters that are far away count as one dipole.
class SolidAngle {
 public:
  explicit SolidAngle(SurfacePtr surface);

  // 1 inside and 0 outside of a closed mesh; in between where it has gaps. Meshes of fewer than
  // 1000 triangles are summed without approximation.
  double winding(Vec3 p) const;

 private:
  struct Node {
    Vec3 center;                  // weighted by area
    Vec3 area_vector;             // sum over the triangles
    double radius = 0;            // all of the node lies within, seen from the centre
    uint32_t begin = 0, end = 0;  // in order_
    uint32_t right = 0;           // the left child follows its parent; 0: a leaf
  };

  uint32_t build(uint32_t begin, uint32_t end);
  void summarize(Node& node) const;
  Vec3 centroid(uint32_t triangle) const;

  SurfacePtr surface_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
  bool is_exact_ = false;
};

}  // namespace ombre::importing
