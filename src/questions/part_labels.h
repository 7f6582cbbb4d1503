// Gives the contents of named parts the label "part".
#pragma once

#include "design/design.h"

namespace ombre::compile {

inline constexpr const char* part_label = "part";

// Returns the design with a node for each name that only its list of parts has, so that all contents of a named part
// have the label.
design::Design with_part_nodes(design::Design design);
// Returns the names of the label in the order of its numbers, from 1 on. The design must come from with_part_nodes.
std::vector<std::string> part_names(const design::Design& design);
void report_nameless_parts(const design::Design& design, Diagnostics& diagnostics);

}  // namespace ombre::compile
