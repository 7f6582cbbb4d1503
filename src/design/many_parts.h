// The inputs of a node as many parts of a few kinds (program/parts.h).
#pragma once

#include <memory>
#include <vector>

#include "design/lowered.h"
#include "program/parts.h"

namespace ombre::design {

// What is asked of the parts besides "inside".
enum class PartQuery : uint8_t {
  interior,  // only whether a point is inside and not on the surface; nothing else
  mix,       // of the composition: sums over the parts that hold the point, and their number
  first,     // the composition of the first part that holds the point
  last,
};

// Parts at a point, as fields.
struct PartFields {
  Field inside;                    // or interior
  Field count;                     // of mix: how many hold the point
  Composition composition;         // of mix: sums of fractions; checks where they are 1
  std::vector<size_t> others;      // inputs that are not among the parts
  std::optional<MaterialId> only;  // all parts are of this one material, and nothing can be wrong
};

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
