// Results of simulations as field sources.
#pragma once

#include "import/fields/result_mesh.h"
#include "program/field_source.h"

namespace ombre::importing {

// The values outside of the mesh.
struct OutsideRule {
  enum class Kind : uint8_t { none, nearest, value };
  Kind kind = Kind::none;
  double within_mm = Box::inf;  // of nearest, and of points: as far as this
  double value = 0;

  bool operator==(const OutsideRule&) const = default;
};

// The name of a component's channel; both are counted from 0, in the order of the results.
std::string result_channel_name(size_t field, size_t component);

// Channels: "inside", 1 in the mesh and else 0; and those of the fields' components:
// between nodes by the elements' shape functions, of elements constant. Without a value they are NaN.
program::SourceField make_result_source(std::string name, std::shared_ptr<const ResultMesh> mesh,
                                        const OutsideRule& outside, const Hash& content);

// Is it a source of results on a mesh, which says what is inside of it?
bool is_mesh_result(const program::FieldSource& source);

// The same of points without a mesh: between them the nearest one's value, or the mean of the nearest eight, weighted
// by the inverse of their squared distances (D. Shepard, A two-dimensional interpolation function for
// irregularly-spaced data, 1968). Where no point is within `within_mm` there is no value, or the rule's; "inside" is 0.
program::SourceField make_scattered_source(std::string name, std::shared_ptr<const formats::Results> results,
                                           bool takes_nearest, const OutsideRule& outside, const Hash& content);

}  // namespace ombre::importing
