// Keeps the values of stages for a later run of the same job.
#pragma once

#include <optional>
#include <string>

#include "base/system/hash.h"

namespace ombre::compile {

// It is used from one thread at a time.
class StageKeeper {
 public:
  virtual ~StageKeeper() = default;
  // Returns what was kept under the hash of everything that the values are made from; nothing if that is not there.
  virtual std::optional<std::string> find(const Hash& made_from) = 0;
  virtual void keep(const Hash& made_from, std::string values) = 0;
};

}  // namespace ombre::compile
