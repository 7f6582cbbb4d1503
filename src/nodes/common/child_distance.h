// Variables of expressions that refer to a node's input: d, its signed distance, and t, the position along its struts.
// Warns if the input has no distances.
#pragma once

#include <algorithm>
#include <span>

#include "design/node.h"
#include "expr/expression.h"

namespace ombre::nodes {

// Returns the input's variables. Keeps references to both arguments.
inline expr::Variables child_variables(const design::Inputs& in, const program::Point& p) {
  return [&in, &p](std::string_view name) -> std::optional<program::Field> {
    if (name == "d") return in.distance(0, p);
    if (name == "t") return in.output(0, design::along_output, p)[0];
    const std::string attribute = in.attribute_called(0, name);
    return attribute.empty() ? std::nullopt : std::optional(in.attribute(0, attribute, p, design::Demand::inside));
  };
}

// Warns if the input has no distance in mm. `user` is what needs it, such as "offset".
inline void warn_of_implicit_distance(const design::Reader& reader, const design::Node& input,
                                      const std::string& user = "\"d\"") {
  if (!input.metric().is_implicit()) return;
  reader.diagnostics.warning(Code::distance_unknown, reader.where,
                             user + " needs distances, but this shape only gives a sign",
                             "the result may not be in mm; redistance gives it distances");
}

// Returns false and adds a diagnostic if the numbers use variables that the input does not have.
inline bool check_child_variables(const design::Reader& reader, const design::Node& input,
                                  std::span<const design::Number> numbers) {
  const auto use = [&](std::string_view name) {
    return std::ranges::any_of(numbers,
                               [&](const design::Number& n) { return n.expression() && n.expression()->uses(name); });
  };
  if (use("d")) warn_of_implicit_distance(reader, input);
  if (!use("t") || input.output_type(design::along_output)) return true;
  return reader.refuse("\"t\", the place along a strut, is used over what has no struts",
                       "use it directly over strut or lattice");
}

}  // namespace ombre::nodes
