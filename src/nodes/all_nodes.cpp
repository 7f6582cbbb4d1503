#include "nodes/all_nodes.h"

#include "nodes/common/families.h"

namespace ombre::nodes {

const design::Registry& registry() {
  static const design::Registry all = [] {
    design::Registry nodes;
#define OMBRE_ADD_FAMILY(family) add_##family(nodes);
    OMBRE_NODE_FAMILIES(OMBRE_ADD_FAMILY)
#undef OMBRE_ADD_FAMILY
    return nodes;
  }();
  return all;
}

}  // namespace ombre::nodes
