#include "formats/mesh/mesh_objects.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace ombre::formats {
namespace {

bool is_called(const MeshGroup& group, const std::string& name) { return group.name == name || group.object == name; }

// Gives the mesh only the vertices that its triangles use, and renumbers them.
void take_used_vertices(const std::vector<Vec3>& vertices, Mesh& mesh) {
  constexpr uint32_t unused = UINT32_MAX;
  std::vector<uint32_t> number(vertices.size(), unused);
  for (auto& triangle : mesh.triangles)
    for (uint32_t& corner : triangle) {
      if (number[corner] == unused) {
        number[corner] = static_cast<uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(vertices[corner]);
      }
      corner = number[corner];
    }
}

template <class T>
void append_range(std::vector<T>& to, const std::vector<T>& from, const MeshGroup& group) {
  if (from.empty()) return;
  const auto first = from.begin() + group.first_triangle;
  to.insert(to.end(), first, first + group.triangle_count);
}

}  // namespace

std::vector<std::string> object_names(const Mesh& mesh) {
  std::vector<std::string> names;
  std::set<std::string_view> known;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && known.insert(name).second) names.push_back(name);
  };
  for (const MeshGroup& group : all_groups(mesh)) {
    add(group.object);
    add(group.name);
  }
  return names;
}

std::vector<MeshGroup> all_groups(const Mesh& mesh) {
  std::vector<MeshGroup> groups = mesh.groups;
  for (const PlacedLattice& placed : mesh.lattices) groups.push_back(placed.group);
  return groups;
}

Mesh groups_of(const Mesh& mesh, const std::vector<bool>& flags) {
  Mesh kept;
  for (size_t n = 0; n < mesh.groups.size(); ++n) {
    if (!flags[n]) continue;
    MeshGroup group = mesh.groups[n];
    append_range(kept.triangles, mesh.triangles, group);
    append_range(kept.texture_triangles, mesh.texture_triangles, group);
    group.first_triangle = static_cast<uint32_t>(kept.triangles.size()) - group.triangle_count;
    kept.groups.push_back(std::move(group));
  }
  for (size_t n = 0; n < mesh.lattices.size(); ++n)
    if (flags[mesh.groups.size() + n]) kept.lattices.push_back(mesh.lattices[n]);
  kept.texture_coordinates = mesh.texture_coordinates;
  take_used_vertices(mesh.vertices, kept);
  return kept;
}

bool keep_object(Mesh& mesh, const std::string& name) {
  std::vector<bool> flags;
  for (const MeshGroup& group : all_groups(mesh)) flags.push_back(is_called(group, name));
  if (std::find(flags.begin(), flags.end(), true) == flags.end()) return false;
  mesh = groups_of(mesh, flags);
  return true;
}

}  // namespace ombre::formats
