// Distances of a node's input: the variable d of expressions, and warnings where they are none.
#pragma once

#include "design/node.h"
#include "expr/expression.h"

namespace ombre::nodes {

// Keeps references to both arguments.
inline expr::Variables distance_variable(const design::Inputs& in, const program::Point& p) {
  return [&in, &p](std::string_view name) -> std::optional<program::Field> {
    if (name != "d") return std::nullopt;
    return in.distance(0, p);
  };
}

// `use` says who takes the value for a distance: "offset measures from".
inline void warn_of_implicit_distance(const design::Reader& reader, const design::Node& input,
                                      const std::string& use = "\"d\" is used over") {
  if (!input.metric().is_implicit()) return;
  reader.diagnostics.warning(reader.where, use + " a shape of which only the sign is known",
                             "its value is taken as it is, which need not be a distance in mm");
}

}  // namespace ombre::nodes
