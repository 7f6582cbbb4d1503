// Geometry from files.
#pragma once

#include <optional>

#include "base/text/diagnostic.h"
#include "solids/solid.h"

namespace ombre::solids {

// A solid of a mesh that nobody vouches for; nothing, and an error, where it is not closed or crosses itself.
// Shells that overlap become one. `what` begins the message.
std::optional<Solid> checked_solid(const TriangleMesh& mesh, const std::string& what, const SourceRange& where,
                                   Diagnostics& messages);

// STL, OFF, OBJ, PLY, AMF, 3MF: a solid for each material and colour of each object, with the names and colours that
// the file gives. SVG and DXF: one region. Nothing, and messages, where there is none.
Pieces import_pieces(const Import& import, const SourceRange& where, Diagnostics& messages);

// Heights at the points of a grid, 1 mm apart, down to 1 mm below the lowest.
TriangleMesh mesh_of(const Surface& surface, const SourceRange& where, Diagnostics& messages);

}  // namespace ombre::solids
