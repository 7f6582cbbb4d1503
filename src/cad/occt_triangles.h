// Triangles of a meshed shape. Only for this folder, because it includes the library's headers.
#pragma once

#include <TopoDS_Shape.hxx>

#include "cad/solids.h"

namespace ombre::cad {

// Returns the triangles; faces share the vertices of their common edges. Throws Error if a face has no triangles;
// `what` names the shape in messages.
Triangles triangles_of(const TopoDS_Shape& shape, const std::string& what);

// Returns a compound of the shape's faces, in their order, without their borders: all of each surface between the least
// and greatest u and v of its face.
TopoDS_Shape whole_faces_of(const TopoDS_Shape& shape);

// Returns the meshed faces with the coordinates of their surfaces. Throws as triangles_of().
std::vector<FaceMesh> face_meshes_of(const TopoDS_Shape& shape, const std::string& what);

}  // namespace ombre::cad
