#include "formats/mesh_objects.h"

#include <set>
#include <string_view>

namespace ombre::formats {
namespace {

bool is_called(const MeshGroup& group, const std::string& name) { return group.name == name || group.object == name; }

// Vertices that no triangle uses go away.
void drop_unused_vertices(Mesh& mesh) {
  constexpr uint32_t unused = UINT32_MAX;
  std::vector<uint32_t> number(mesh.vertices.size(), unused);
  std::vector<Vec3> kept;
  for (auto& triangle : mesh.triangles)
    for (uint32_t& corner : triangle) {
      if (number[corner] == unused) {
        number[corner] = static_cast<uint32_t>(kept.size());
        kept.push_back(mesh.vertices[corner]);
      }
      corner = number[corner];
    }
  mesh.vertices = std::move(kept);
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
  for (const MeshGroup& group : mesh.groups) {
    add(group.object);
    add(group.name);
  }
  return names;
}

bool keep_object(Mesh& mesh, const std::string& name) {
  Mesh kept;
  for (MeshGroup group : mesh.groups) {
    if (!is_called(group, name)) continue;
    append_range(kept.triangles, mesh.triangles, group);
    append_range(kept.texture_triangles, mesh.texture_triangles, group);
    group.first_triangle = static_cast<uint32_t>(kept.triangles.size()) - group.triangle_count;
    kept.groups.push_back(std::move(group));
  }
  if (kept.triangles.empty()) return false;
  kept.vertices = std::move(mesh.vertices);
  kept.texture_coordinates = std::move(mesh.texture_coordinates);
  drop_unused_vertices(kept);
  mesh = std::move(kept);
  return true;
}

}  // namespace ombre::formats
