// A cache of results for sub-designs, shared by designs that contain the same ones.
#pragma once

#include <cstddef>
#include <memory>

#include "base/system/hash.h"

namespace ombre::design {

// Thread-safe. A key is a hash of the kind of result and of everything from which it is made, so a key always refers to
// the same content. Designs with functions of a host program have no such hash.
class SubDesignMemory {
 public:
  virtual ~SubDesignMemory() = default;
  // Returns null if it was never kept or has been dropped.
  virtual std::shared_ptr<const void> find(const Hash& key) = 0;
  virtual void keep(const Hash& key, std::shared_ptr<const void> made, size_t bytes) = 0;
};

}  // namespace ombre::design
