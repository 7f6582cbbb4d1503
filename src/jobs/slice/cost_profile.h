// What layers take to make, by height, known from some of them.
#pragma once

#include <cstdint>
#include <map>

#include "jobs/slice/slice_request.h"

namespace ombre::compile {

struct LayerCost {
  double seconds = 0;  // of one thread
  double bytes = 0;    // of images
};

// Between the slabs that are known the cost of a layer changes linearly; beyond them it stays.
class CostProfile {
 public:
  // What the layers of a slab took together. Replaces what was known of a slab with the same middle.
  void add(LayerRange slab, LayerCost cost);

  bool is_empty() const { return layer_costs_.empty(); }
  // Of all layers of a range together; nothing is known before the first add.
  LayerCost of(LayerRange range) const;

 private:
  LayerCost at(double height) const;

  std::map<double, LayerCost> layer_costs_;  // of one layer, by the middle of its slab
};

}  // namespace ombre::compile
