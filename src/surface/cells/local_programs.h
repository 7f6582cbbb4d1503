// Versions of a long program for parts of space, each shortened once and shared by all callers.
#pragma once

#include <memory>

#include "program/program.h"

namespace ombre::surface {

// A cache of shortened programs. Thread-safe; copies share it.
class LocalPrograms {
 public:
  // Constructs the cache of an empty program.
  LocalPrograms();
  // Constructs the cache of a program; its parts of space are halves, quarters and so on of about `space`.
  LocalPrograms(program::Program whole, const Box& space);
  const program::Program& whole() const;

  // Returns a program valid at least in the box: one for a part of space up to a few times larger, or the whole
  // program. The reference stays valid as long as this object.
  const program::Program& around(const Box& box) const;

 private:
  class Cells;
  std::shared_ptr<Cells> cells_;
};

}  // namespace ombre::surface
