// The objects within a mesh.
#pragma once

#include <string>
#include <vector>

#include "formats/mesh/mesh.h"

namespace ombre::formats {

// Returns the names accepted by keep_object(), each once, in the order of the file.
std::vector<std::string> object_names(const Mesh& mesh);

// Returns the groups of triangles, followed by those of lattices.
std::vector<MeshGroup> all_groups(const Mesh& mesh);

// Returns the groups whose flag is set, in order, with the vertices that they use; `flags` belongs to all_groups().
Mesh groups_of(const Mesh& mesh, const std::vector<bool>& flags);

// Keeps only the groups whose name, or whose object's name, is `name`. Returns false and leaves the mesh unchanged if
// there are none.
bool keep_object(Mesh& mesh, const std::string& name);

}  // namespace ombre::formats
