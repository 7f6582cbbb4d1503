// Meshes of files need an inside.
#pragma once

#include <string>
#include <string_view>

#include "sources/mesh_materials.h"

namespace ombre::sources {

// The mesh of a file, for messages.
std::string mesh_called(const std::string& path);

// False, and a diagnostic, when the mesh has no inside under the rule. Small faults are mended. `subject` begins the
// messages.
bool make_closed(const std::string& subject, formats::Mesh& mesh, std::string_view rule, const design::Reader& reader);

// The same for what a file has of one material, when the whole is closed.
bool check_part_closed(const std::string& path, const MaterialMesh& part, std::string_view rule,
                       const design::Reader& reader);

// The same for the meshes that its lattices are clipped by.
bool close_clips(const std::string& path, formats::Mesh& mesh, std::string_view rule, const design::Reader& reader);

}  // namespace ombre::sources
