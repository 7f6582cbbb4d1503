// A long program as it is in parts of space, each shortened once for all who ask there.
#pragma once

#include <memory>

#include "program/program.h"

namespace ombre::surface {

// Thread-safe; copies share what was shortened.
class LocalPrograms {
 public:
  // Of nothing.
  LocalPrograms();
  // Parts of space are halves, quarters and so on of about this box.
  LocalPrograms(program::Program whole, const Box& space);
  const program::Program& whole() const;

  // What is left of it somewhere around a box, within a few times its size, or in the whole of space. It stays.
  const program::Program& around(const Box& box) const;

 private:
  class Cells;
  std::shared_ptr<Cells> cells_;
};

}  // namespace ombre::surface
