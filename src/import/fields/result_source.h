// Results of simulations as field sources.
#pragma once

#include "import/fields/result_mesh.h"
#include "program/field_source.h"

namespace ombre::importing {

// The rule for values outside of the mesh.
struct OutsideRule {
  enum class Kind : uint8_t { none, nearest, value };
  Kind kind = Kind::none;
  double within_mm = Box::inf;  // greatest distance, for the kind nearest and for scattered points
  double value = 0;

  bool operator==(const OutsideRule&) const = default;
};

// Returns the name of a component's channel. Both numbers count from 0, in the order of the results.
std::string result_channel_name(size_t field, size_t component);

// Returns the source of a mesh. Its channels are "inside", 1 in the mesh and else 0, and one for each component of each
// field. Values at nodes are interpolated by shape functions, values of elements are constant. Channels are NaN where
// there is no value.
program::SourceField make_result_source(std::string name, std::shared_ptr<const ResultMesh> mesh,
                                        const OutsideRule& outside, const Hash& content);

// Returns true if the source holds results on a mesh, which defines an inside.
bool is_mesh_result(const program::FieldSource& source);

// Returns the source of points without a mesh. Values are those of the nearest point, or the mean of the nearest eight,
// weighted by the inverse of their squared distances (D. Shepard, A two-dimensional interpolation function for
// irregularly-spaced data, 1968). If no point is within `within_mm`, the rule's value is used, or NaN; "inside" is 0.
program::SourceField make_scattered_source(std::string name, std::shared_ptr<const formats::Results> results,
                                           bool takes_nearest, const OutsideRule& outside, const Hash& content);

}  // namespace ombre::importing
