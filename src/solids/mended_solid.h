// Solids of meshes that people and files give.
#pragma once

#include <optional>
#include <string>

#include "base/text/diagnostic.h"
#include "solids/solid.h"

namespace ombre::solids {

// Returns the solid of an untrusted mesh. Overlapping shells become one. Corners that differ by rounding are joined,
// and missing faces are added; a note or a warning says so. If the surface is still open, reports an error and returns
// null. A shell that crosses itself stays as it is, with a warning; where it is combined with others, a point is inside
// if the surface winds around it. `what` begins the messages.
std::optional<Solid> mended_solid(TriangleMesh mesh, const std::string& what, const SourceRange& where,
                                  Diagnostics& messages);

}  // namespace ombre::solids
