// Named unit cells of strut lattices from the literature.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/vec.h"

namespace ombre::nodes {

// Struts in a cell of side one, centred on the origin. They meet the planes x = 0, y = 0 and z = 0 only at their ends,
// so half a cell contains whole struts. Struts on the cell's faces are shared with its neighbours.
struct UnitCell {
  std::string_view name, meaning;
  std::vector<std::pair<Vec3, Vec3>> struts;
  bool is_mirrored = true;  // along each axis, the two halves are mirror images
};

const std::vector<UnitCell>& unit_cells();
const UnitCell* find_unit_cell(std::string_view name);
std::vector<std::string> unit_cell_names();

}  // namespace ombre::nodes
