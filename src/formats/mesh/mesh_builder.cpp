// Builds a mesh from the vertices, polygons and groups that a file lists.
#include "formats/mesh/mesh_builder.h"

#include <algorithm>

namespace ombre::formats {
namespace {

constexpr uint32_t no_texture = UINT32_MAX;
constexpr std::array<float, 4> white{1, 1, 1, 1};

}  // namespace

void MeshBuilder::end_group() {
  if (mesh_.groups.empty()) return;
  MeshGroup& last = mesh_.groups.back();
  last.triangle_count = static_cast<uint32_t>(mesh_.triangles.size()) - last.first_triangle;
  if (last.triangle_count == 0) mesh_.groups.pop_back();
}

void MeshBuilder::start_group(const std::string& name, const std::string& material) {
  end_group();
  if (!mesh_.groups.empty() && mesh_.groups.back().name == name && mesh_.groups.back().material == material) return;
  mesh_.groups.push_back({name, static_cast<uint32_t>(mesh_.triangles.size()), 0, material});
}

void MeshBuilder::add_triangle(std::span<const uint32_t> corners, std::span<const uint32_t> texture, Corners of) {
  mesh_.triangles.push_back({corners[of[0]], corners[of[1]], corners[of[2]]});
  if (!texture.empty() && !has_texture_) {
    has_texture_ = true;
    mesh_.texture_triangles.resize(mesh_.triangles.size() - 1, {no_texture, no_texture, no_texture});
  }
  if (!has_texture_) return;
  if (texture.empty())
    mesh_.texture_triangles.push_back({no_texture, no_texture, no_texture});
  else
    mesh_.texture_triangles.push_back({texture[of[0]], texture[of[1]], texture[of[2]]});
}

void MeshBuilder::add_polygon(std::span<const uint32_t> corners, std::span<const uint32_t> texture) {
  if (mesh_.groups.empty()) start_group("");
  if (corners.size() == 3) {
    add_triangle(corners, texture, {0, 1, 2});
    return;
  }
  points_.clear();
  for (const uint32_t corner : corners) points_.push_back(mesh_.vertices[corner]);
  for (const Corners& triangle : cutter_.cut(points_)) add_triangle(corners, texture, triangle);
}

void MeshBuilder::add_colour(const std::array<double, 4>& colour) {
  mesh_.vertex_colours.resize(mesh_.vertices.size() - 1, white);
  std::array<float, 4> kept;
  std::ranges::transform(colour, kept.begin(), [](double part) { return static_cast<float>(part); });
  mesh_.vertex_colours.push_back(kept);
}

void MeshBuilder::finish_colours() {
  if (mesh_.vertex_colours.empty()) return;
  const auto is_byte = [](const std::array<float, 4>& colour) {
    return *std::max_element(colour.begin(), colour.end() - 1) > 1;
  };
  const bool are_bytes = std::ranges::any_of(mesh_.vertex_colours, is_byte);
  mesh_.vertex_colours.resize(mesh_.vertices.size(), are_bytes ? std::array<float, 4>{255, 255, 255, 255} : white);
  for (auto& colour : mesh_.vertex_colours)
    for (float& part : colour) part = part >= 0 ? std::min(are_bytes ? part / 255 : part, 1.0F) : 0.0F;
}

MeshBuilder::Result MeshBuilder::finish() {
  end_group();
  finish_colours();
  Result result{std::move(mesh_), 0};
  Mesh& mesh = result.mesh;
  if (!has_texture_) mesh.texture_coordinates.clear();
  for (auto& triangle : mesh.texture_triangles) {
    if (triangle[0] != no_texture) continue;
    if (result.untextured++ == 0) mesh.texture_coordinates.push_back({0, 0});
    triangle.fill(static_cast<uint32_t>(mesh.texture_coordinates.size() - 1));
  }
  return result;
}

MeshBuilder::Result MeshBuilder::finish(std::vector<Vec3> vertices) {
  mesh_.vertices = std::move(vertices);
  return finish();
}

}  // namespace ombre::formats
