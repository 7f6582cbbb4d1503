// Writes meshes as files for other programs.
#pragma once

#include <string>

#include "formats/packages/mesh_formats.h"

namespace ombre::exporting {

using formats::MeshFormat;

// Returns the path of the second file of a mesh, such as part.mtl for part.obj; "" for formats of one file.
std::string companion_path(const std::string& path, const MeshFormat& format);

// Writes a file atomically: it appears complete or not at all. A companion is written if the document has materials.
// `flavour` applies to 3MF. Throws Error with the path, the reason and what to do.
void write_mesh_file(const std::string& path, const formats::MeshDocument& document, const MeshFormat& format,
                     formats::SlicerFlavour flavour = formats::SlicerFlavour::generic);

}  // namespace ombre::exporting
