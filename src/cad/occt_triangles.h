// Triangles of a shape that was meshed. Only for this folder: it includes the library's headers.
#pragma once

#include <TopoDS_Shape.hxx>

#include "cad/solids.h"

namespace ombre::cad {

// Faces that meet in an edge get the same vertices there. Throws Error when a face has no triangles; `what` is the
// shape, for messages.
Triangles triangles_of(const TopoDS_Shape& shape, const std::string& what);

}  // namespace ombre::cad
