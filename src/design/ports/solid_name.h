// Solids as parameters.
#pragma once

#include "design/outputs.h"
#include "design/ports/port.h"

namespace ombre::design {

// A solid on which a value is measured: a solid node, or an output that is a solid or region. The node with the
// parameter owns it. Null if none is given.
struct SolidName {
  const Node* node = nullptr;
  size_t output = 0;  // of a node of values
  bool operator==(const SolidName&) const = default;
};

template <>
struct Port<SolidName> {
  static PortText text(const Domain&) { return {"solid", "solids", "Solid"}; }
  static bool read(const Data& data, const Domain&, SolidName& value, const Reader& reader) {
    const auto solid = read_solid(data, reader);
    if (solid) value = {solid->node, solid->output};
    return solid.has_value();
  }
  static Data write(const SolidName& value, bool) {
    return value.node ? write_solid({value.node, value.output}) : Data();
  }
};

}  // namespace ombre::design
