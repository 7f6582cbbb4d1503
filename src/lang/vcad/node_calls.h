// From calls with arguments, by position or name and in older forms too, to nodes.
#pragma once

#include <optional>
#include <vector>

#include "design/registry.h"
#include "lang/engine/vocabulary.h"

namespace ombre::lang {

// A parameter for every argument. Nothing, and diagnostics, when one has none.
std::optional<std::vector<design::NamedValue>> bound_arguments(const design::NodeType& type,
                                                               std::vector<Argument> arguments,
                                                               const design::Reader& reader);

// The union of several nodes, or the only one.
design::NodePtr joined(std::vector<design::NodePtr> nodes, const design::Registry& registry,
                       const design::Reader& reader);

// make_node, where several inputs are joined for a node that takes one.
design::NodePtr make_called(const design::NodeType& type, const std::vector<design::NamedValue>& values,
                            std::vector<design::NodePtr> inputs, const design::Registry& registry,
                            const design::Reader& reader);

}  // namespace ombre::lang
