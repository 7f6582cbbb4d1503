// Geometry from files.
#pragma once

#include <optional>

#include "base/text/diagnostic.h"
#include "solids/solid.h"

namespace ombre::solids {

// Imports a file. STL, OFF, OBJ, PLY, AMF and 3MF give a solid for each material and colour of each object, with the
// names and colours of the file; SVG and DXF give one region. Returns no pieces, with messages, if there are none.
Pieces import_pieces(const Import& import, const SourceRange& where, Diagnostics& messages);

// Returns the solid below heights on a grid of 1 mm, down to 1 mm below the lowest.
TriangleMesh mesh_of(const Surface& surface, const SourceRange& where, Diagnostics& messages);

}  // namespace ombre::solids
