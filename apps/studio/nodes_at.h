// Finds the calls of a script that a point of its design lies in.
#pragma once

#include <vector>

#include "base/math/box.h"
#include "base/system/progress.h"
#include "design/design.h"

namespace ombre::studio {

// Returns the nodes from that of a part to the innermost solid whose inside holds the point (mm), each an input of the
// one before; returns none where the point lies outside of the design. Of several inputs that hold the point it is the
// first, or the last where the node says that the last counts. The list ends at nodes that make a new shape of their
// inputs, such as offsets, and of very many parts around one point. Throws Cancelled.
std::vector<const design::Node*> nodes_at(const design::Design& design, Vec3 point, const StopFlag& stop);

}  // namespace ombre::studio
