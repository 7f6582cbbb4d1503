// Frames of coordinates that nodes have as parameters.
#pragma once

#include <cmath>
#include <optional>

#include "base/math/vec.h"
#include "nodes/common/parameter_checks.h"

namespace ombre::nodes {

struct Frame {
  Vec3 origin, axis{0, 0, 1}, toward{1, 0, 0};  // its origin, the direction of its z, and about that of its x
};

// Returns the map from the node's space to the frame. Returns nothing and adds an error if the axis has no direction.
inline std::optional<Affine> frame_from_space(const Frame& frame, const design::Reader& reader) {
  if (!has_direction(reader, "axis", frame.axis)) return std::nullopt;
  const Vec3 z = (1 / length(frame.axis)) * frame.axis;
  Vec3 x = frame.toward - dot(frame.toward, z) * z;
  if (!(length(x) > 1e-9 * length(frame.toward)))  // any perpendicular direction is acceptable
    x = std::abs(z.x) < 0.9 ? Vec3{1, 0, 0} - z.x * z : Vec3{0, 1, 0} - z.y * z;
  x = (1 / length(x)) * x;
  Affine map;
  map.rows = {x, cross(z, x), z};
  map.offset = {-dot(map.rows[0], frame.origin), -dot(map.rows[1], frame.origin), -dot(map.rows[2], frame.origin)};
  return map;
}

}  // namespace ombre::nodes
