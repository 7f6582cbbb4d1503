// Values that vary in space, as objects of the script language: formulas of outputs of nodes.
#pragma once

#include <optional>

#include "design/outputs.h"
#include "design/registry.h"
#include "lang/engine/value.h"

namespace ombre::lang {

// What values are made with; it outlives them.
struct ValueMaker {
  const design::Registry& registry;
  const design::MaterialTable& materials;
};

// What a call of a value node gives: its first output, which stands for it, and the others as parts.
Value value_of(const design::NodePtr& node, const ValueMaker& maker, Meter& meter);
// What a call of a solid gives in an expression.
Value solid_value(const design::NodePtr& node, Meter& meter);

}  // namespace ombre::lang
