// The cost of layers by height, interpolated between known ones.
#pragma once

#include <cstdint>
#include <map>

#include "jobs/common/layer_range.h"

namespace ombre::compile {

struct LayerCost {
  double seconds = 0;  // time on one thread
  double bytes = 0;    // size of images
};

// A profile in which the cost of a layer changes linearly between known slabs, and is constant beyond them.
class CostProfile {
 public:
  // Adds the cost of all layers of a slab together. Replaces that of a slab with the same middle.
  void add(LayerRange slab, LayerCost cost);

  bool is_empty() const { return layer_costs_.empty(); }
  // Returns the cost of all layers of a range together; nothing is known before the first add.
  LayerCost of(LayerRange range) const;

 private:
  LayerCost at(double height) const;

  std::map<double, LayerCost> layer_costs_;  // cost of one layer, by the middle of its slab
};

}  // namespace ombre::compile
