// Mesh files from a document, one writer per format. Lengths are mm, z is up; bodies without triangles are left out,
// and beams from all formats but 3MF.
//
// The bytes are made while they are read, from the document, which must live as long. Equal documents give equal
// bytes. Coordinates are rounded to floats. All but write_3mf throw Error for what a format cannot hold.
#pragma once

#include <string>

#include "formats/lazy_bytes.h"
#include "formats/mesh_document.h"

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
// AMF: one object, a volume for each body.
LazyBytes amf_bytes(const MeshDocument& document);
// glTF 2.0, binary: a node for each body. Its own unit and axes are metres with y up, so the nodes lie in one with a
// matrix; colours are linear.
LazyBytes glb_bytes(const MeshDocument& document);

// Whom a 3MF file is for, since slicers take the material of a region from files of their own.
enum class SlicerFlavour {
  generic,  // for any program: an object for each body, together one part; both slicers below find their settings
  prusa,    // PrusaSlicer: one object, whose bodies are ranges of its triangles
  bambu,    // Bambu Studio and OrcaSlicer: as generic, with colours in the form that these read
};

// Not in builds without libzip.
bool can_write_3mf();
// Throws what the standard library throws, std::system_error where the disk fails; Error where it cannot be written.
void write_3mf(const std::string& path, const MeshDocument& document, SlicerFlavour flavour);

}  // namespace ombre::formats
