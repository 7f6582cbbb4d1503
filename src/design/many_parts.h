// Solids within a node, stored as many parts of a few kinds (program/parts.h).
#pragma once

#include <memory>
#include <vector>

#include "design/lowered.h"
#include "program/parts.h"

namespace ombre::design {

// A set of parts, in no particular frame.
struct ManyParts {
  std::shared_ptr<const program::PartSet> set;
  // The slots that hold a composition.
  struct CompositionSlots {
    std::vector<std::pair<MaterialId, size_t>> materials;  // materials and their slots, in ascending order
    std::vector<std::pair<uint32_t, size_t>> checks;       // numbers of Lowering's checks and their slots
  };

  size_t count_slot = 0, along_slot = 0, weight_slot = 0;  // 0 if there is no such slot
  CompositionSlots held, weighed;  // composition of parts that hold the point, and weighted composition
  std::vector<size_t> others;
  std::optional<MaterialId> only;

  PartFields at(const Point& p) const;
};

}  // namespace ombre::design
