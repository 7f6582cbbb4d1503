// Checks of parameters that several families have. Each returns false and adds an error if something is wrong.
#pragma once

#include <optional>
#include <string>

#include "base/math/vec.h"
#include "design/reader.h"

namespace ombre::nodes {

// The direction is the node's parameter of this name.
inline bool has_direction(const design::Reader& reader, const std::string& name, Vec3 direction) {
  if (length(direction) > 0) return true;
  return reader.refuse(
      "the " + name + " of " + std::string(reader.node) + " has no direction",
      "write " + spelled::either("x, y, z or for example (1, 1, 0)", "for example [1, 1, 0]", "for example (1, 1, 0)"));
}

// The corners are those of the box to which a node is cut, or none.
inline bool is_box_or_none(const design::Reader& reader, const std::optional<Vec3>& min,
                           const std::optional<Vec3>& max) {
  const std::string node(reader.node);
  if (min.has_value() != max.has_value())
    return reader.refuse(node + " needs both corners of its box, min and max, or none");
  if (!min || (min->x < max->x && min->y < max->y && min->z < max->z)) return true;
  return reader.refuse("the box of " + node + " is empty: max must be greater than min on each axis");
}

}  // namespace ombre::nodes
