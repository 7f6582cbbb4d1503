// The objects within a mesh.
#pragma once

#include <string>
#include <vector>

#include "formats/mesh/mesh.h"

namespace ombre::formats {

// The names by which keep_object() finds something, each once, in the order of the file.
std::vector<std::string> object_names(const Mesh& mesh);

// Those of the triangles, then those of the lattices.
std::vector<MeshGroup> all_groups(const Mesh& mesh);

// The groups whose flag is set, in order, with the vertices that they use; `flags` is for all_groups().
Mesh groups_of(const Mesh& mesh, const std::vector<bool>& flags);

// Keeps the groups whose name is `name`, or whose object's is. False, and an unchanged mesh, if there are none.
bool keep_object(Mesh& mesh, const std::string& name);

}  // namespace ombre::formats
