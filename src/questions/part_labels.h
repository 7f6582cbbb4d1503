// Names of parts as the label "part" of what they hold.
#pragma once

#include "design/design.h"

namespace ombre::compile {

inline constexpr const char* part_label = "part";

// The design with a node for each name that only its list of parts has, so that all that is in a named part has the
// label.
design::Design with_part_nodes(design::Design design);
// The label's names, in the order of its numbers, from 1 on. The design has its nodes.
std::vector<std::string> part_names(const design::Design& design);
void report_nameless_parts(const design::Design& design, Diagnostics& diagnostics);

}  // namespace ombre::compile
