#include "fea/model/physics.h"

namespace ombre::fea {

const std::vector<PhysicsWords>& all_physics() {
  static const std::vector<PhysicsWords> table{
      {"mechanics"},
      {"heat",
       {"conductivity_w_mk", "conductivity", "W/(m K)"},
       {"temperature_c", "temperature", "C"},
       {"heat_w", "heat", "W"},
       {"flux_w_mm2", "heat flux", "W/mm2"},
       "20",
       "flux_w_mm2",
       true},
      {"electric",
       {"conductivity_s_m", "conductivity", "S/m"},
       {"potential_v", "potential", "V"},
       {"current_a", "current", "A"},
       {"current_a_mm2", "current density", "A/mm2"},
       "0",
       "density_a_mm2",
       false},
  };
  return table;
}

const PhysicsWords& words_of(Physics physics) { return all_physics()[static_cast<size_t>(physics)]; }

}  // namespace ombre::fea
