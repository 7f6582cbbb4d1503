// What was made of sub-designs, kept for designs that have them again.
#pragma once

#include <cstddef>
#include <memory>

#include "base/system/hash.h"

namespace ombre::design {

// Thread-safe. A key is the hash of all that a thing is made from, of the kind of thing as well, so that it never holds
// anything else. Designs with functions of a host program have no such hash.
class SubDesignMemory {
 public:
  virtual ~SubDesignMemory() = default;
  // Null if it is not there, or no more.
  virtual std::shared_ptr<const void> find(const Hash& key) = 0;
  virtual void keep(const Hash& key, std::shared_ptr<const void> made, size_t bytes) = 0;
};

}  // namespace ombre::design
