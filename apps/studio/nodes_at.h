// Finds the calls of a script that made the solid at a point.
#pragma once

#include <vector>

#include "base/math/box.h"
#include "base/system/progress.h"
#include "design/design.h"

namespace ombre::studio {

// Returns the nodes from that of a part to the innermost solid that holds the point (mm), each an input of the one
// before. Returns none if the point lies outside of the design. Of several inputs that hold the point it takes the
// first, or the last if the node says that the last counts. The list ends at nodes that make a new shape of their
// inputs, such as offsets, and at nodes with very many parts around a point. Throws Cancelled.
std::vector<const design::Node*> nodes_at(const design::Design& design, Vec3 point, const StopFlag& stop);

}  // namespace ombre::studio
