// Materials and mixtures as parameters.
#pragma once

#include <string>
#include <vector>

#include "design/materials.h"
#include "design/outputs.h"
#include "design/ports/lists.h"
#include "design/ports/numbers.h"

namespace ombre::design {

// A material of the design's table, which outlives the nodes, or an output that is a mixture and whose node the node
// with the parameter owns. Both are null if no material is given.
struct MaterialName {
  const Material* material = nullptr;
  GivenOutput mixture = {};
  bool is_given() const { return material || mixture.node; }
  bool operator==(const MaterialName&) const = default;
};

// A number or a material. If neither is given, it is the number 0.
struct NumberOrMaterial {
  Number number;
  MaterialName material;
  bool operator==(const NumberOrMaterial&) const = default;
};

// The design's material for the name `name` in a file.
struct MaterialForName {
  std::string name;
  MaterialName material;
  bool operator==(const MaterialForName&) const = default;
};

// The material at a number.
struct MaterialStop {
  double at = 0;
  MaterialName material;
  bool operator==(const MaterialStop&) const = default;
};

template <>
struct Port<MaterialName> {
  static PortText text(const Domain& domain) {
    return {domain.may_mix ? "material or mixture" : "material", "materials", "Material", "material"};
  }
  static bool read(const Data& data, const Domain& domain, MaterialName& value, const Reader& reader);
  static Data write(const MaterialName& value, bool for_hash);
  // The material of a solid may be a mixture, unless the solid has a composition of its own.
  static void adapt(Domain& domain, bool has_composition) { domain.may_mix = domain.may_mix || !has_composition; }
  static void fill(MaterialName& value, const Reader& reader) {
    if (!value.is_given()) value.material = &reader.materials.first();
  }
};

template <>
struct Port<NumberOrMaterial> {
  static PortText text(const Domain&) {
    return {"number, field, material or mixture", "numbers or materials", "Union[Number, Material]"};
  }
  static bool read(const Data& data, const Domain& domain, NumberOrMaterial& value, const Reader& reader);
  static Data write(const NumberOrMaterial& value, bool for_hash);
  static bool uses_cell(const NumberOrMaterial& value) { return value.number.uses_cell(); }
};

template <>
struct Port<MaterialForName> {
  static PortText text(const Domain&) {
    return {"name with a material", "names with materials", "tuple[str, Material]"};
  }
  static bool read(const Data& data, const Domain& domain, MaterialForName& value, const Reader& reader);
  static Data write(const MaterialForName& value, bool for_hash);
  static bool is_one(const Data& data) {
    return !data.list() || (!data.list()->empty() && !data.list()->front().list());
  }
};

template <>
struct Port<MaterialStop> {
  static PortText text(const Domain&) {
    return {"number with a material", "numbers with materials", "tuple[float, Material]"};
  }
  static bool read(const Data& data, const Domain& domain, MaterialStop& value, const Reader& reader);
  static Data write(const MaterialStop& value, bool for_hash);
};

}  // namespace ombre::design
