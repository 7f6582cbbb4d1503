// The model of a finite-element job: elements, their materials, supports and loads.
// Units: mm, N, MPa; densities in tonne/mm3, so that mm/s2 times tonne is N. Heat: W, degrees Celsius; currents: A, V.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fea/model/bricks.h"
#include "fea/model/element_mesh.h"
#include "fea/model/physics.h"
#include "fea/model/repeat.h"

namespace ombre::fea {

// The properties of a linear, isotropic material.
struct Elastic {
  double modulus_mpa = 0, poissons_ratio = 0;
  double density_t_mm3 = 0;  // 0: unknown
  bool operator==(const Elastic&) const = default;
};

// Shear and bulk modulus, MPa.
struct Moduli {
  double shear = 0, bulk = 0;
};

// Converts Young's modulus and Poisson's ratio.
inline Moduli moduli_of(double modulus_mpa, double poissons_ratio) {
  return {modulus_mpa / (2 * (1 + poissons_ratio)), modulus_mpa / (3 * (1 - 2 * poissons_ratio))};
}

// Elements with equal properties.
struct Section {
  std::string name;
  Elastic elastic;
  double conductivity = 0;  // conductivity of heat, W/(m K), or of electricity, S/m; 0: unknown
};

// A field of values for elements or nodes; each has `components` values one after the other.
struct ValueField {
  std::string name, unit;
  size_t components = 1;
  std::vector<float> values;
};

struct Model {
  Bricks bricks;
  std::vector<Section> sections;
  std::vector<uint16_t> section_of;  // number of the section of each brick
  std::vector<ValueField> fields;    // values of bricks: fractions, attributes
  double design_mm3 = 0;             // volume of the design within the bricks, if it was measured; else 0

  const Elastic& elastic(size_t brick) const { return sections[section_of[brick]].elastic; }
};

// A model on a mesh of any elements.
struct MeshModel {
  Mesh mesh;
  std::vector<Section> sections;
  std::vector<uint16_t> section_of;  // number of the section of each element
  std::vector<ValueField> fields;    // values of elements

  const Elastic& elastic(size_t element) const { return sections[section_of[element]].elastic; }
};

// A view of a model for writers, studies and solvers: on bricks or on another mesh, which must outlive it.
struct ModelView {
  ModelView(const Model& model)  // NOLINT: a view of what is handed over
      : mesh(model.bricks), sections(model.sections), section_of(model.section_of), fields(model.fields) {}
  ModelView(const MeshModel& model)  // NOLINT
      : mesh(model.mesh), sections(model.sections), section_of(model.section_of), fields(model.fields) {}
  // Makes a view with other sections.
  ModelView(const ModelView& model, const std::vector<Section>& others, const std::vector<uint16_t>& other_of)
      : mesh(model.mesh), sections(others), section_of(other_of), fields(model.fields) {}

  MeshView mesh;
  const std::vector<Section>& sections;
  const std::vector<uint16_t>& section_of;
  const std::vector<ValueField>& fields;

  const Section& section(size_t element) const { return sections[section_of[element]]; }
  const Elastic& elastic(size_t element) const { return section(element).elastic; }
};

// A value that is prescribed at a node along an axis.
struct Prescribed {
  uint32_t node = 0;
  uint8_t axis = 0;  // 0 if a node has one unknown
  double value = 0;  // displacement, mm; or force, N; temperature, degrees Celsius, or heat that enters, W; V or A
};

// Heat that leaves through an outer side: coefficient times (temperature - ambient).
struct Film {
  OuterSide side;
  double coefficient_w_m2k = 0, ambient_c = 0;
};

// The nodes of a support or a load, with their name in a deck.
struct NodeSet {
  std::string name;
  std::vector<uint32_t> nodes;  // ascending
};

// Supports and loads of nodes. Both lists are in ascending order of nodes, then axes, without duplicates.
struct Conditions {
  std::vector<Prescribed> displacements, forces;
  std::vector<NodeSet> sets = {};
  Physics physics = Physics::mechanics;
  std::vector<Film> films = {};  // only for heat
  std::optional<Repeat> repeat = {};
};

}  // namespace ombre::fea
