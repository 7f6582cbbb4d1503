// Solids within a node as many parts of a few kinds (program/parts.h).
#pragma once

#include <memory>
#include <vector>

#include "design/lowered.h"
#include "program/parts.h"

namespace ombre::design {

// A set of parts, without a place.
struct ManyParts {
  std::shared_ptr<const program::PartSet> set;
  // What compositions come from.
  struct CompositionSlots {
    std::vector<std::pair<MaterialId, size_t>> materials;  // ascending
    std::vector<std::pair<uint32_t, size_t>> checks;       // numbers of Lowering's checks
  };

  size_t count_slot = 0, along_slot = 0, weight_slot = 0;  // 0: there is none
  CompositionSlots held, weighed;                          // of parts that hold the point; by their weights
  std::vector<size_t> others;
  std::optional<MaterialId> only;

  PartFields at(const Point& p) const;
};

}  // namespace ombre::design
