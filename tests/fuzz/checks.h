// What fuzz targets of scripts and designs check.
#pragma once

#include <cstdlib>

#include "base/text/diagnostic.h"

namespace ombre::fuzz {

inline void require(bool condition) {
  if (!condition) std::abort();
}

// Diagnostics that have places lie in their texts, and can be printed.
inline void check_places(const Diagnostics& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics.list()) {
    const SourceRange& where = diagnostic.where;
    require(!where.source || (where.begin <= where.end && where.begin <= where.source->text().size()));
  }
  (void)to_text(diagnostics);
}

}  // namespace ombre::fuzz
