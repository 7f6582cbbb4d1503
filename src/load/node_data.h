// Describes node types as data, for programs.
#pragma once

#include "base/text/data.h"
#include "design/registry.h"

namespace ombre::compile {

// Returns the members "name", "category", "sentence", "parameters", "inputs", "gives", "outputs", "example".
DataMembers describe_node(const design::NodeType& type);

}  // namespace ombre::compile
