// Convex hulls, and triangles between the rings of plane regions.
#include "solids/cgal_boxes.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/convex_hull_3.h>

#include <deque>

#include "solids/cgal_body.h"

namespace ombre::solids {
namespace {

using Quick = CGAL::Exact_predicates_inexact_constructions_kernel;
using QuickMesh = CGAL::Surface_mesh<Quick::Point_3>;

constexpr uint32_t no_point = UINT32_MAX;

struct PointNumber {
  uint32_t value = no_point;
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<PointNumber, Quick>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Quick, CGAL::Constrained_triangulation_face_base_2<Quick>>;
using Storage = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Quick, Storage, CGAL::Exact_predicates_tag>;

constexpr int unseen = -1;

// How many rings go round each face, from the outside inwards.
void count_rings(Triangulation& triangles) {
  for (auto face = triangles.all_faces_begin(); face != triangles.all_faces_end(); ++face) face->info() = unseen;
  std::deque<Triangulation::Face_handle> near{triangles.infinite_face()}, behind;
  for (int depth = 0; !near.empty(); ++depth, near.swap(behind), behind.clear())
    while (!near.empty()) {
      const Triangulation::Face_handle face = near.front();
      near.pop_front();
      if (face->info() != unseen) continue;
      face->info() = depth;
      for (int i = 0; i < 3; ++i) {
        if (face->neighbor(i)->info() != unseen) continue;
        (face->is_constrained(i) ? behind : near).push_back(face->neighbor(i));
      }
    }
}

Triangulation triangulation_of(std::span<const Ring> rings) {
  Triangulation triangles;
  uint32_t number = 0;
  for (const Ring& ring : rings) {
    std::vector<Triangulation::Vertex_handle> corners;
    for (const Vec2& p : ring) {
      const size_t before = triangles.number_of_vertices();
      corners.push_back(triangles.insert(Quick::Point_2(p.x, p.y)));
      if (triangles.number_of_vertices() > before) corners.back()->info().value = number;
      ++number;
    }
    for (size_t n = 0; n < corners.size(); ++n)
      if (corners[n] != corners[(n + 1) % corners.size()])
        triangles.insert_constraint(corners[n], corners[(n + 1) % corners.size()]);
  }
  return triangles;
}

}  // namespace

TriangleMesh hull_of(std::span<const Vec3> points) {
  std::vector<Quick::Point_3> all;
  for (const Vec3& p : points) all.emplace_back(p.x, p.y, p.z);
  TriangleMesh result;
  if (all.size() < 4) return result;
  size_t other = 1;  // than the first point, and then one beside their line, and one beside their plane
  while (other < all.size() && all[other] == all[0]) ++other;
  size_t third = other + 1;
  while (third < all.size() && CGAL::collinear(all[0], all[other], all[third])) ++third;
  size_t fourth = third + 1;
  while (fourth < all.size() && CGAL::coplanar(all[0], all[other], all[third], all[fourth])) ++fourth;
  if (fourth >= all.size()) return result;
  QuickMesh mesh;
  CGAL::convex_hull_3(all.begin(), all.end(), mesh);
  std::vector<uint32_t> number(mesh.num_vertices());
  for (const auto vertex : mesh.vertices()) {
    const Quick::Point_3& p = mesh.point(vertex);
    number[vertex] = static_cast<uint32_t>(result.points.size());
    result.points.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto face : mesh.faces()) {
    std::vector<uint32_t> corners;
    for (const auto vertex : vertices_around_face(mesh.halfedge(face), mesh)) corners.push_back(number[vertex]);
    for (size_t n = 2; n < corners.size(); ++n) result.triangles.push_back({corners[0], corners[n - 1], corners[n]});
  }
  return result;
}

PlaneTriangles triangulate_rings(std::span<const Ring> rings) {
  Triangulation triangles = triangulation_of(rings);
  count_rings(triangles);
  PlaneTriangles result;
  uint32_t count = 0;
  for (const Ring& ring : rings) count += static_cast<uint32_t>(ring.size());
  for (auto vertex = triangles.finite_vertices_begin(); vertex != triangles.finite_vertices_end(); ++vertex) {
    if (vertex->info().value != no_point) continue;
    vertex->info().value = count++;
    result.crossings.push_back({vertex->point().x(), vertex->point().y()});
  }
  for (auto face = triangles.finite_faces_begin(); face != triangles.finite_faces_end(); ++face) {
    if (face->info() % 2 == 0) continue;
    result.triangles.push_back(
        {face->vertex(0)->info().value, face->vertex(1)->info().value, face->vertex(2)->info().value});
  }
  return result;
}

}  // namespace ombre::solids
