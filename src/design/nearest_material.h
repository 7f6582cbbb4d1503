// Which material a colour means.
#pragma once

#include "design/materials.h"

namespace ombre::design {

// The one whose colour is nearest, by the squares of red, green, blue and opacity; the first on ties. void has no
// colour.
const Material& nearest_material(const Rgba& colour, const MaterialTable& table);

}  // namespace ombre::design
