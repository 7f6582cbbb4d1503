// Mapping of colours to materials.
#pragma once

#include "design/materials.h"

namespace ombre::design {

// Returns the material whose colour is nearest, by the sum of squared differences of red, green, blue and opacity. The
// first one wins a tie. void has no colour.
const Material& nearest_material(const Rgba& colour, const MaterialTable& table);

}  // namespace ombre::design
