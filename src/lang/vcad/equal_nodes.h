// Merges equal nodes of a design.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/system/hash.h"
#include "design/node.h"

namespace ombre::lang {

// Remembers the latest tens of thousands of nodes. Remembering more would take as much memory as the nodes themselves.
class EqualNodes {
 public:
  // Returns the first remembered node with the same type, parameters and inputs, or the given node if there is none.
  design::NodePtr first(design::NodePtr node);

 private:
  struct Slot {
    Hash hash;
    design::NodePtr node;  // null if free
  };
  struct Table {
    std::vector<Slot> slots;  // each node is in the slot of its hash or after it
    size_t count = 0;

    design::NodePtr find(const Hash& hash) const;
    void add(const Hash& hash, design::NodePtr node);
    // Returns the slot with that hash, or the free one where it belongs.
    size_t place(const Hash& hash) const;
    void widen();
  };

  Table latest_, older_;
  std::string key_;  // key of the node that is sought
};

}  // namespace ombre::lang
