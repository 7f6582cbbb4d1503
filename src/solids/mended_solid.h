// Solids of meshes that people and files give.
#pragma once

#include <optional>
#include <string>

#include "base/text/diagnostic.h"
#include "solids/solid.h"

namespace ombre::solids {

// Returns the solid of an untrusted mesh. Overlapping shells become one. Corners that differ by rounding are joined,
// and missing faces are added; a note or a warning says so. A surface that is still open, or crosses itself, stays as
// it is, with a warning. An open one cannot be combined with others; with one that crosses itself, a point is inside if
// the surface winds around it. Reports other errors and returns null. `what` begins the messages.
std::optional<Solid> mended_solid(TriangleMesh mesh, const std::string& what, const SourceRange& where,
                                  Diagnostics& messages);

}  // namespace ombre::solids
