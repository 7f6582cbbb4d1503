// Convex hulls, and triangulation of plane regions given by rings.
#include "solids/cgal/cgal_boxes.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <numeric>

#include "solids/cgal/cgal_body.h"

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

// Counts how many rings enclose each face, from the outside inwards.
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

// Returns the facet of each face of a hull; coplanar neighbours belong to one facet.
std::vector<uint32_t> facets_of(const QuickMesh& mesh) {
  std::vector<uint32_t> facet(mesh.num_faces());
  std::iota(facet.begin(), facet.end(), 0);
  const auto root = [&](uint32_t n) {
    while (facet[n] != n) n = facet[n] = facet[facet[n]];
    return n;
  };
  for (const auto edge : mesh.edges()) {
    const auto h = mesh.halfedge(edge), o = mesh.opposite(h);
    const auto &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h));
    const auto &r = mesh.point(mesh.target(mesh.next(h))), &s = mesh.point(mesh.target(mesh.next(o)));
    // A triangle without area lies in the planes of all its neighbours.
    if (CGAL::collinear(p, q, r) || CGAL::collinear(p, q, s) || !CGAL::coplanar(p, q, r, s)) continue;
    const uint32_t a = root(mesh.face(h)), b = root(mesh.face(o));
    facet[std::max(a, b)] = std::min(a, b);
  }
  for (uint32_t n = 0; n < facet.size(); ++n) facet[n] = root(n);
  return facet;
}

// Numbers of the points around a facet.
using Outline = std::vector<uint32_t>;

// Returns the outline without points on the line between their neighbours, rotated to begin with the lowest number.
Outline corners_of(const Outline& outline, std::span<const Vec3> points) {
  const auto at = [&](size_t n) {
    const Vec3& p = points[outline[n % outline.size()]];
    return Quick::Point_3(p.x, p.y, p.z);
  };
  Outline corners;
  for (size_t n = 0; n < outline.size(); ++n)
    if (!CGAL::collinear(at(n + outline.size() - 1), at(n), at(n + 1))) corners.push_back(outline[n]);
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

// Returns the facets of a hull; equal points have the number of the first of them. CGAL's own triangles of a facet, and
// its choice of points on facets and edges that are not corners, depend on memory addresses.
std::vector<Outline> outlines_of(const QuickMesh& mesh, std::span<const Vec3> points) {
  const auto key = [](const auto& x, const auto& y, const auto& z) { return std::array<double, 3>{x, y, z}; };
  std::map<std::array<double, 3>, uint32_t> first;
  for (uint32_t n = 0; n < points.size(); ++n) first.emplace(key(points[n].x, points[n].y, points[n].z), n);
  const auto number = [&](auto vertex) {
    const Quick::Point_3& p = mesh.point(vertex);
    return first.at(key(p.x(), p.y(), p.z()));
  };
  const std::vector<uint32_t> facet = facets_of(mesh);
  std::map<uint32_t, std::map<uint32_t, uint32_t>> next;  // successor of each point around each facet
  for (const auto h : mesh.halfedges())
    if (facet[mesh.face(h)] != facet[mesh.face(mesh.opposite(h))])
      next[facet[mesh.face(h)]][number(mesh.source(h))] = number(mesh.target(h));
  std::vector<Outline> outlines;
  for (const auto& [ignored, steps] : next) {
    Outline outline{steps.begin()->first};
    while (outline.size() < steps.size()) outline.push_back(steps.at(outline.back()));
    Outline corners = corners_of(outline, points);
    if (corners.size() > 2) outlines.push_back(std::move(corners));
  }
  std::ranges::sort(outlines);
  return outlines;
}

TriangleMesh by_facets(const QuickMesh& mesh, std::span<const Vec3> points) {
  const std::vector<Outline> outlines = outlines_of(mesh, points);
  std::map<uint32_t, uint32_t> place;
  for (const Outline& outline : outlines)
    for (const uint32_t n : outline) place.emplace(n, 0);
  TriangleMesh result;
  for (auto& [n, to] : place) {
    to = static_cast<uint32_t>(result.points.size());
    result.points.push_back(points[n]);
  }
  for (const Outline& outline : outlines)
    for (size_t n = 2; n < outline.size(); ++n)
      result.triangles.push_back({place[outline[0]], place[outline[n - 1]], place[outline[n]]});
  return result;
}

}  // namespace

TriangleMesh hull_of(std::span<const Vec3> points) {
  std::vector<Quick::Point_3> all;
  for (const Vec3& p : points) all.emplace_back(p.x, p.y, p.z);
  TriangleMesh result;
  if (all.size() < 4) return result;
  size_t other = 1;  // finds a point different from the first, then one off their line, then one off their plane
  while (other < all.size() && all[other] == all[0]) ++other;
  size_t third = other + 1;
  while (third < all.size() && CGAL::collinear(all[0], all[other], all[third])) ++third;
  size_t fourth = third + 1;
  while (fourth < all.size() && CGAL::coplanar(all[0], all[other], all[third], all[fourth])) ++fourth;
  if (fourth >= all.size()) return result;
  QuickMesh mesh;
  CGAL::convex_hull_3(all.begin(), all.end(), mesh);
  return by_facets(mesh, points);
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
