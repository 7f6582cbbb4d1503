// Builds a mesh from the vertices, polygons and groups that a file lists.
#pragma once

#include <span>
#include <string>

#include "formats/mesh/mesh.h"
#include "formats/mesh/polygon.h"

namespace ombre::formats {

class MeshBuilder {
 public:
  static constexpr size_t most_vertices = UINT32_MAX - 1;

  // Starts a group, to which the following faces belong.
  void start_group(const std::string& name, const std::string& material = "");

  // Adds a vertex; at most most_vertices in total.
  void add_vertex(Vec3 p) { mesh_.vertices.push_back(p); }
  void add_texture_coordinate(double u, double v) { mesh_.texture_coordinates.push_back({u, v}); }
  // Gives the last vertex a colour: red, green, blue and alpha, from 0 to 1, or to 255 if one of the file is above 1.
  // Vertices without one are white.
  void add_colour(const std::array<double, 4>& colour);
  size_t vertex_count() const { return mesh_.vertices.size(); }
  size_t texture_coordinate_count() const { return mesh_.texture_coordinates.size(); }
  size_t triangle_count() const { return mesh_.triangles.size(); }

  // Adds a polygon of at least three corners, which are numbers of vertices. Texture coordinates: none, or one per
  // corner.
  void add_polygon(std::span<const uint32_t> corners, std::span<const uint32_t> texture = {});

  // The mesh with complete groups. `untextured` is the number of triangles that got the texture coordinate (0, 0)
  // because only other triangles have texture coordinates.
  struct Result {
    Mesh mesh;
    size_t untextured = 0;
  };
  Result finish();
  // Finishes with these vertices instead of those added one by one.
  Result finish(std::vector<Vec3> vertices);

 private:
  void add_triangle(std::span<const uint32_t> corners, std::span<const uint32_t> texture, Corners of);
  void end_group();
  void finish_colours();

  Mesh mesh_;
  PolygonCutter cutter_;
  std::vector<Vec3> points_;
  bool has_texture_ = false;
};

}  // namespace ombre::formats
