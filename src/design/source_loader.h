// How nodes get at what lies in files: they ask, somebody else reads.
#pragma once

#include "base/diagnostic.h"
#include "program/field_source.h"

namespace ombre::design {

class SourceLoader {
 public:
  virtual ~SourceLoader() = default;
  // A triangle mesh with the channels "inside" and "distance". `path` is made relative to what was
  // found; null and diagnostics when it is missing, wrong or open. `object` is the name of the object that is meant
  // of those in the file, empty for all. `inside`: "nonzero", "parity" or "generalized".
  virtual program::SourceField mesh(std::string& path, const std::string& object, const std::string& inside,
                                    const SourceRange& where, Diagnostics& diagnostics) = 0;
};

}  // namespace ombre::design
