// Writers of 3MF and AMF. Lengths are mm; bodies without triangles are left out, and from AMF beams. Equal documents
// give equal bytes. Coordinates are rounded to floats.
#pragma once

#include <string>

#include "formats/containers/lazy_bytes.h"
#include "formats/mesh/mesh_document.h"

namespace ombre::formats {

// AMF: one object, a volume for each body. Made while it is read, from the document, which must live as long.
LazyBytes amf_bytes(const MeshDocument& document);

// Whom a 3MF file is for, since slicers take the material of a region from files of their own.
enum class SlicerFlavour {
  generic,  // for any program: an object for each body, together one part; both slicers below find their settings
  prusa,    // PrusaSlicer: one object, whose bodies are ranges of its triangles
  bambu,    // Bambu Studio and OrcaSlicer: as generic, with colours in the form that these read
};

// False in builds without libzip.
bool can_write_3mf();
// Throws what the standard library throws, std::system_error where the disk fails; Error where it cannot be written.
void write_3mf(const std::string& path, const MeshDocument& document, SlicerFlavour flavour);

}  // namespace ombre::formats
