// Writes mesh files from a document, with one writer per format. Lengths are mm, z is up; bodies without triangles and
// beams are left out. 3MF and AMF have their own writers, in package_writers.h.
//
// The bytes are generated from the document while they are read, so the document must outlive them. Equal documents
// give equal bytes. Coordinates are rounded to floats. Writers throw Error for contents that a format cannot hold.
#pragma once

#include <string>

#include "formats/containers/lazy_bytes.h"
#include "formats/mesh/mesh_document.h"

namespace ombre::formats {

// Returns binary STL: only triangles, of all bodies in order.
LazyBytes stl_bytes(const MeshDocument& document);
// Returns Wavefront OBJ: objects with their materials, which are in the file `library_name` beside it; colours of
// vertices follow their coordinates.
LazyBytes obj_bytes(const MeshDocument& document, const std::string& library_name);
LazyBytes mtl_bytes(const MeshDocument& document);
// Returns binary PLY: one mesh with a colour for each vertex.
LazyBytes ply_bytes(const MeshDocument& document);
// Returns OFF as text: one mesh, in which each face has the colour of its body.
LazyBytes off_bytes(const MeshDocument& document);
// Returns binary glTF 2.0 with a node for each body. glTF uses metres and y up, so a parent node has a matrix; colours
// are linear.
LazyBytes glb_bytes(const MeshDocument& document);

}  // namespace ombre::formats
