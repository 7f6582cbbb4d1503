// The nodes that need neither formulas nor meshes.
#pragma once

#include "node.h"

namespace baseline {

// A solid of one material.
class Leaf : public Node {
 public:
  Leaf(const Box& box, size_t material) : Node(box), material_(material) {}
  void add_composition(const Point&, Composition& shares) const override { shares[material_] += 1; }

 private:
  size_t material_;
};

NodePtr sphere(double radius, size_t material);
NodePtr block(const Point& size, size_t material);
NodePtr strut(const Point& start, const Point& end, double radius, bool round, size_t material);
NodePtr translate(const Point& by, NodePtr child);
NodePtr unite(Nodes children);
NodePtr intersect(Nodes children);
NodePtr subtract(Nodes children);

}  // namespace baseline
