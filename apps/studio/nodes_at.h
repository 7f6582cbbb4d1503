// Finds the calls in a script whose solids contain a point.
#pragma once

#include <vector>

#include "base/math/box.h"
#include "base/system/progress.h"
#include "design/design.h"

namespace ombre::studio {

// Returns the nodes from a part's node to the innermost solid that contains the point (mm), each an input of the
// previous one; none if the point is outside of the design. If several inputs contain the point, the first is taken, or
// the last if the node gives precedence to the last. The list ends at nodes that make a new shape of their inputs, such
// as offsets, and at very many parts around one point. Throws Cancelled.
std::vector<const design::Node*> nodes_at(const design::Design& design, Vec3 point, const StopFlag& stop);

}  // namespace ombre::studio
