// Attributes by their names: the table of standard ones, and which ones solids have.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "design/node.h"

namespace ombre::design {

// A name that has one meaning in all designs.
struct StandardAttribute {
  std::string_view name;
  ValueType type = ValueType::number;
  std::string_view unit;  // "1": a plain number
  Interval range;         // that its numbers lie in
  double default_value = 0;
  std::string_view meaning;
};

std::span<const StandardAttribute> standard_attributes();
// Null for names that are not standard.
const StandardAttribute* standard_attribute(std::string_view name);

// The attributes that nodes at or below these solids set, each once. They are looked for each time.
std::vector<AttributeDeclaration> attributes_below(std::span<const NodePtr> solids);
// Names in small letters by which formulas call the numbers of these attributes, such as "modulus" and "fibre.x".
std::vector<std::string> names_of_attributes(std::span<const NodePtr> solids);
bool gives_attribute(std::span<const NodePtr> solids, std::string_view lower_case);

}  // namespace ombre::design
