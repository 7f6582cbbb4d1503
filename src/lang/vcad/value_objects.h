// Values that vary in space as objects of the script language: formulas of outputs of nodes.
#pragma once

#include <optional>

#include "design/outputs.h"
#include "design/registry.h"
#include "lang/engine/value.h"

namespace ombre::lang {

// The context in which values are made. It must outlive them.
struct ValueMaker {
  const design::Registry& registry;
  const design::MaterialTable& materials;
};

// Returns the value of a call of a value node: its first output, with the other outputs as parts.
Value value_of(const design::NodePtr& node, const ValueMaker& maker, Meter& meter);
// Returns the value of a call of a solid in an expression.
Value solid_value(const design::NodePtr& node, const ValueMaker& maker, Meter& meter);
// Returns the value of data that a host program gives, which may hold nodes, outputs of nodes and formulas of these.
Value host_value(const Data& data, const ValueMaker& maker, Meter& meter);

}  // namespace ombre::lang
