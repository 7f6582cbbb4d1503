// Equal nodes of a design become one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/system/hash.h"
#include "design/node.h"

namespace ombre::lang {

// Remembers some ten thousands, the latest: more would cost as much memory as the nodes themselves.
class EqualNodes {
 public:
  // Of the remembered nodes with this one's type, parameters and inputs the one that was given first.
  design::NodePtr first(design::NodePtr node);

 private:
  struct Slot {
    Hash hash;
    design::NodePtr node;  // null: free
  };
  struct Table {
    std::vector<Slot> slots;  // each at its hash, or after it
    size_t count = 0;

    design::NodePtr find(const Hash& hash) const;
    void add(const Hash& hash, design::NodePtr node);
    // The slot with that hash, or the free one that it would get.
    size_t place(const Hash& hash) const;
    void widen();
  };

  Table latest_, older_;
  std::string key_;  // of the node that is looked for
};

}  // namespace ombre::lang
