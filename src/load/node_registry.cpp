// Gives the registry of node types to rooms that may not include nodes/.
#include "load/node_registry.h"

#include "nodes/all_nodes.h"

namespace ombre::compile {

const design::Registry& node_registry() { return nodes::registry(); }

}  // namespace ombre::compile
