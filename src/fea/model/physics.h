// The equations that studies may be of, and what each calls its numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ombre::fea {

enum class Physics : uint8_t {
  mechanics,  // displacements, mm
  heat,       // temperatures, degrees Celsius
  electric,   // potentials, V
};

struct Quantity {
  std::string member, name, unit;  // in studies, and in results
};

// Quantities are those of conduction: something flows from where its potential is high to where it is low.
struct PhysicsWords {
  std::string name;  // in studies
  Quantity conductivity = {}, potential = {}, flow = {}, flux = {};
  std::string usual_potential = {};  // for a support, as an example
  std::string flux_event = {};       // its name in events, after "greatest_"
  bool has_films = false;            // loads may go to a medium around
};

// Rows of physics, in the order of Physics.
const std::vector<PhysicsWords>& all_physics();
const PhysicsWords& words_of(Physics physics);

}  // namespace ombre::fea
