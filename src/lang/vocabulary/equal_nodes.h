// Equal nodes of a design become one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/hash.h"
#include "design/node.h"

namespace ombre::lang {

class EqualNodes {
 public:
  // Of the nodes with this one's type, parameters and inputs the one that was given first.
  design::NodePtr first(design::NodePtr node);

 private:
  struct Slot {
    Hash hash;
    design::NodePtr node;  // null: free
  };
  static Slot& slot_of(std::vector<Slot>& slots, const Hash& hash);
  void widen();

  std::vector<Slot> slots_;  // each at its hash, or after it
  size_t count_ = 0;
  std::string key_;  // of the node that is looked for
};

}  // namespace ombre::lang
