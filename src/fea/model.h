// The model of a finite-element job: bricks, their materials, and what holds and pulls them.
//
// Units: mm, N, MPa; densities in tonne/mm3, so that mm/s2 times tonne is N.
#pragma once

#include <string>
#include <vector>

#include "fea/bricks.h"

namespace ombre::fea {

// Linear, isotropic.
struct Elastic {
  double modulus_mpa = 0, poissons_ratio = 0;
  double density_t_mm3 = 0;  // 0: unknown
  bool operator==(const Elastic&) const = default;
};

// Bricks of the same properties.
struct Section {
  std::string name;
  Elastic elastic;
};

// A value for each brick or node, or `components` values one after the other.
struct ValueField {
  std::string name, unit;
  size_t components = 1;
  std::vector<float> values;
};

struct Model {
  Bricks bricks;
  std::vector<Section> sections;
  std::vector<uint16_t> section_of;  // of each brick
  std::vector<ValueField> fields;    // of bricks: fractions, attributes

  const Elastic& elastic(size_t brick) const { return sections[section_of[brick]].elastic; }
};

// A value that is prescribed at a node along an axis.
struct Prescribed {
  uint32_t node = 0;
  uint8_t axis = 0;
  double value = 0;  // displacement, mm; or force, N
};

// Both lists are in ascending order of nodes, then axes, and name no place twice.
struct Conditions {
  std::vector<Prescribed> displacements, forces;
};

}  // namespace ombre::fea
