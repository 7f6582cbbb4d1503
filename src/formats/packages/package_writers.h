// Writers of 3MF and AMF. Lengths are mm; bodies without triangles are left out, and in AMF beams too. Equal documents
// give equal bytes. Coordinates are rounded to floats.
#pragma once

#include <string>

#include "formats/containers/lazy_bytes.h"
#include "formats/mesh/mesh_document.h"
#include "formats/slicers/flavour.h"

namespace ombre::formats {

// Returns AMF: one object with a volume for each body. The bytes are generated from the document, which must outlive
// them.
LazyBytes amf_bytes(const MeshDocument& document);

// Returns false in builds without libzip.
bool can_write_3mf();
// Writes a file. Throws exceptions of the standard library, std::system_error for I/O errors; Error if this build
// cannot write 3MF.
void write_3mf(const std::string& path, const MeshDocument& document, SlicerFlavour flavour);

}  // namespace ombre::formats
