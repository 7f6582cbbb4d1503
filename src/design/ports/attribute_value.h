// Values of attributes as parameters.
#pragma once

#include <array>
#include <span>

#include "design/ports/material_names.h"

namespace ombre::design {

// The value of an attribute: one number, three numbers of a vector, four numbers of a colour, or a mixture of
// materials.
struct AttributeValue {
  ValueType type = ValueType::number;
  std::array<Number, 4> numbers{};
  MaterialName mixture = {};  // mixture of materials, for the type mixture
  std::span<const Number> used() const;
  bool operator==(const AttributeValue&) const = default;
};

template <>
struct Port<AttributeValue> {
  static PortText text(const Domain&) {
    return {"number, field, vector, colour or mixture", "values", "Union[Number, Numbers, Material]"};
  }
  static bool read(const Data& data, const Domain& domain, AttributeValue& value, const Reader& reader);
  static Data write(const AttributeValue& value, bool for_hash);
  static bool uses_cell(const AttributeValue& value) { return std::ranges::any_of(value.used(), &Number::uses_cell); }
};

}  // namespace ombre::design
