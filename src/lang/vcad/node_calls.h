// Makes nodes from calls, whose arguments may be positional, named or in older forms.
#pragma once

#include <optional>
#include <vector>

#include "design/registry.h"
#include "lang/engine/vocabulary.h"

namespace ombre::lang {

// Assigns a parameter to every argument. Returns nothing and adds diagnostics if one has none.
std::optional<std::vector<design::NamedValue>> bound_arguments(const design::NodeType& type,
                                                               std::vector<Argument> arguments,
                                                               const design::Reader& reader);

// Returns the union of several nodes, or the only one.
design::NodePtr joined(std::vector<design::NodePtr> nodes, const design::Registry& registry,
                       const design::Reader& reader);

// Calls make_node after joining the inputs if the node takes only one.
design::NodePtr make_called(const design::NodeType& type, const std::vector<design::NamedValue>& values,
                            std::vector<design::NodePtr> inputs, const design::Registry& registry,
                            const design::Reader& reader);

}  // namespace ombre::lang
