// Attributes by name: the table of standard ones, and those that solids have.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "design/node.h"

namespace ombre::design {

// An attribute whose name has the same meaning in all designs.
struct StandardAttribute {
  std::string_view name;
  ValueType type = ValueType::number;
  std::string_view unit;  // "1" for a plain number
  Interval range;         // range of its numbers
  double default_value = 0;
  std::string_view meaning;
};

std::span<const StandardAttribute> standard_attributes();
// Returns null for names that are not standard.
const StandardAttribute* standard_attribute(std::string_view name);

// Returns the attributes that nodes at or below these solids set, each once. The search is repeated at each call.
std::vector<AttributeDeclaration> attributes_below(std::span<const NodePtr> solids);
// Returns the lower-case names of these attributes' numbers in formulas, such as "modulus" and "fibre.x".
std::vector<std::string> names_of_attributes(std::span<const NodePtr> solids);
bool gives_attribute(std::span<const NodePtr> solids, std::string_view lower_case);

}  // namespace ombre::design
