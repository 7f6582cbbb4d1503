// Meshes as files for other programs.
#pragma once

#include <optional>
#include <string>

#include "formats/packages/package_writers.h"

namespace ombre::exporting {

enum class MeshFormat { stl, obj, ply, off, amf, three_mf, glb };

// What the ending of a path asks for; nothing if it is none of ours.
std::optional<MeshFormat> mesh_format_of(const std::string& path);
// Whether its files say which triangles are which body.
bool holds_bodies(MeshFormat format);
// The endings, for messages: ".3mf, .amf, ...".
std::string mesh_endings();
// The endings of formats that hold bodies, for messages.
std::string endings_with_bodies();

// The file of materials beside an .obj file: part.mtl for part.obj.
std::string material_library_path(const std::string& path);

// Writes a file that appears whole or not at all, and with OBJ its materials if there are any. `flavour` is for 3MF.
// Throws Error with the path, the reason and what to do.
void write_mesh_file(const std::string& path, const formats::MeshDocument& document, MeshFormat format,
                     formats::SlicerFlavour flavour = formats::SlicerFlavour::generic);

}  // namespace ombre::exporting
