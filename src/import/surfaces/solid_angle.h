// Generalized winding numbers: the share of the solid angle around a point that a surface covers, even with gaps.
#pragma once

#include "import/surfaces/surface.h"

namespace ombre::importing {

// Approximates distant clusters by dipoles (Barill, Dickson, Schmidt, Levin and Jacobson, "Fast winding numbers for
// soups and clouds", 2018).
class SolidAngle {
 public:
  explicit SolidAngle(SurfacePtr surface);

  // Returns the winding number: 1 inside and 0 outside of a closed mesh, in between near gaps. Meshes of fewer than
  // 1000 triangles are summed exactly.
  double winding(Vec3 p) const;

 private:
  struct Node {
    Vec3 center;                  // weighted by area
    Vec3 area_vector;             // sum over the triangles
    double radius = 0;            // radius around the centre of a ball that contains the node
    uint32_t begin = 0, end = 0;  // range in order_
    uint32_t right = 0;           // index of the right child; the left one follows its parent; 0 in a leaf
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
