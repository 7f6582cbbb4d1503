// Tests of maps of cells at points of their regions.
#pragma once

#include <optional>

#include "nodes/common/made_fields.h"
#include "nodes/common/slopes.h"

namespace ombre::nodes {

// Returns the first of side^3 points of a box for which `is_wanted(point)`, or nothing.
template <class IsWanted>
std::optional<Vec3> find_tested_point(const Box& box, int side, const IsWanted& is_wanted) {
  const Vec3 step = (1.0 / side) * box.size();
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const Vec3 at = box.lo + Vec3{(i + 0.5) * step.x, (j + 0.5) * step.y, (k + 0.5) * step.z};
        if (is_wanted(at)) return at;
      }
  return std::nullopt;
}

inline program::Field determinant_of(const std::array<Slope, 3>& rows) {
  return dot_without_zeros(rows[0], cross_without_zeros(rows[1], rows[2]));
}

// A field that the search evaluates at a point.
using FieldAt = std::function<program::Field(design::Lowering&, const program::Point&)>;

// Returns a point of the region, among side^3 of a box, at which the determinant of the derivatives of u, v and w is 0
// or has another sign than at the first one, or nothing. `roots` are the nodes that both fields use; `outside` is g of
// the region.
std::optional<Vec3> find_folded_cell(const design::Reader& reader, const std::vector<design::NodePtr>& roots,
                                     const Box& box, int side, const FieldAt& outside, const FieldAt& determinant);

// Adds an error that names the place. Returns false.
bool refuse_folded(const design::Reader& reader, Vec3 at, const std::string& hint);

}  // namespace ombre::nodes
