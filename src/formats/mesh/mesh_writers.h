// Mesh files from a document, one writer per format. Lengths are mm, z is up; bodies without triangles are left out,
// and beams. 3MF and AMF have writers of their own: package_writers.h.
//
// The bytes are made while they are read, from the document, which must live as long. Equal documents give equal
// bytes. Coordinates are rounded to floats. Writers throw Error for what a format cannot hold.
#pragma once

#include <string>

#include "formats/containers/lazy_bytes.h"
#include "formats/mesh/mesh_document.h"

namespace ombre::formats {

// Binary STL: triangles alone, of all bodies in order.
LazyBytes stl_bytes(const MeshDocument& document);
// Wavefront OBJ: objects with their materials, which lie in the file `library_name` beside it; colours of vertices
// behind their coordinates.
LazyBytes obj_bytes(const MeshDocument& document, const std::string& library_name);
LazyBytes mtl_bytes(const MeshDocument& document);
// Binary PLY: one mesh, a colour for each vertex.
LazyBytes ply_bytes(const MeshDocument& document);
// OFF as text: one mesh, the colour of its body for each face.
LazyBytes off_bytes(const MeshDocument& document);
// glTF 2.0, binary: a node for each body. Its own unit and axes are metres with y up, so the nodes lie in one with a
// matrix; colours are linear.
LazyBytes glb_bytes(const MeshDocument& document);

}  // namespace ombre::formats
