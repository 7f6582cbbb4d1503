// The inputs of a node as many parts of a few kinds (program/parts.h).
#pragma once

#include <memory>
#include <vector>

#include "design/lowered.h"
#include "program/parts.h"

namespace ombre::design {

// A set of parts, without a place.
struct ManyParts {
  std::shared_ptr<const program::PartSet> set;
  size_t count_slot = 0;
  std::vector<std::pair<MaterialId, size_t>> material_slots;  // ascending
  std::vector<std::pair<uint32_t, size_t>> check_slots;       // numbers of Lowering's checks
  std::vector<size_t> others;
  std::optional<MaterialId> only;

  PartFields at(const Point& p) const;
};

}  // namespace ombre::design
