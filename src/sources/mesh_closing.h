// Ensures that meshes from files enclose a volume.
#pragma once

#include <string>
#include <string_view>

#include "sources/mesh_materials.h"

namespace ombre::sources {

// Returns how messages refer to the mesh of a file.
std::string mesh_called(const std::string& path);

// Repairs small faults. Returns false, with a diagnostic, if the mesh has no inside under the rule. `subject` begins
// the messages.
bool make_closed(const std::string& subject, formats::Mesh& mesh, std::string_view rule, const design::Reader& reader);

// Checks the part of one material of a closed mesh. Returns false, with a diagnostic, if it has no inside under the
// rule.
bool check_part_closed(const std::string& path, const MaterialMesh& part, std::string_view rule,
                       const design::Reader& reader);

// Closes the meshes that clip the mesh's lattices. Returns false, with a diagnostic, if one has no inside under the
// rule.
bool close_clips(const std::string& path, formats::Mesh& mesh, std::string_view rule, const design::Reader& reader);

}  // namespace ombre::sources
