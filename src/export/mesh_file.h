// Writes meshes as files for other programs.
#pragma once

#include <optional>
#include <string>

#include "formats/packages/package_writers.h"

namespace ombre::exporting {

enum class MeshFormat { stl, obj, ply, off, amf, three_mf, glb };

// Returns the format that belongs to the ending of a path, or null if it is unknown.
std::optional<MeshFormat> mesh_format_of(const std::string& path);
// Returns true if files of the format record which triangles belong to which body.
bool holds_bodies(MeshFormat format);
// Returns the endings, for messages: ".3mf, .amf, ...".
std::string mesh_endings();
// Returns the endings of formats that record bodies, for messages.
std::string endings_with_bodies();

// Returns the path of the material file of an .obj file: part.mtl for part.obj.
std::string material_library_path(const std::string& path);

// Writes a file atomically: it appears complete or not at all. OBJ files with materials get a material file. `flavour`
// applies to 3MF. Throws Error with the path, the reason and what to do.
void write_mesh_file(const std::string& path, const formats::MeshDocument& document, MeshFormat format,
                     formats::SlicerFlavour flavour = formats::SlicerFlavour::generic);

}  // namespace ombre::exporting
