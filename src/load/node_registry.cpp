// The node types that designs are made of, for those who may not look into nodes/.
#include "load/node_registry.h"

#include "nodes/all_nodes.h"

namespace ombre::compile {

const design::Registry& node_registry() { return nodes::registry(); }

}  // namespace ombre::compile
