// The nodes that do what a step of a chain says.
#pragma once

#include "load/node_maker.h"
#include "load/resolved_step.h"

namespace ombre::compile {

// Returns the solid with what the step gives. Returns null, and adds diagnostics, if a node cannot be made.
design::NodePtr with_step(const design::NodePtr& solid, const ResolvedStep& step, const NodeMaker& maker);

// Returns the solid with an attribute that is rounded to multiples of a step.
design::NodePtr with_rounded(const design::NodePtr& solid, const std::string& attribute, double step,
                             const NodeMaker& maker);

}  // namespace ombre::compile
