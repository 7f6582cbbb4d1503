// What expressions know of a node's input: d, its signed distance, and t, the place along its struts; warnings where
// distances are none.
#pragma once

#include <algorithm>
#include <span>

#include "design/node.h"
#include "expr/expression.h"

namespace ombre::nodes {

// Keeps references to both arguments.
inline expr::Variables child_variables(const design::Inputs& in, const program::Point& p) {
  return [&in, &p](std::string_view name) -> std::optional<program::Field> {
    if (name == "d") return in.distance(0, p);
    if (name == "t") return in.along(0, p);
    const std::string attribute = in.attribute_called(0, name);
    return attribute.empty() ? std::nullopt : std::optional(in.attribute(0, attribute, p, design::Demand::inside));
  };
}

// `user` names what needs a distance: "offset".
inline void warn_of_implicit_distance(const design::Reader& reader, const design::Node& input,
                                      const std::string& user = "\"d\"") {
  if (!input.metric().is_implicit()) return;
  reader.diagnostics.warning(Code::distance_unknown, reader.where,
                             user + " needs distances, but this shape only gives a sign",
                             "the result may not be in mm; redistance gives it distances");
}

// False, and a diagnostic, when the numbers use what the input does not know.
inline bool check_child_variables(const design::Reader& reader, const design::Node& input,
                                  std::span<const design::Number> numbers) {
  const auto use = [&](std::string_view name) {
    return std::ranges::any_of(numbers,
                               [&](const design::Number& n) { return n.expression() && n.expression()->uses(name); });
  };
  if (use("d")) warn_of_implicit_distance(reader, input);
  if (!use("t") || input.has_along()) return true;
  reader.diagnostics.error(reader.where, "\"t\", the place along a strut, is used over what has no struts",
                           "use it directly over strut or lattice");
  return false;
}

}  // namespace ombre::nodes
