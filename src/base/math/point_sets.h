// Convex hulls, Delaunay's tetrahedra and Voronoi edges of points in space.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/math/box.h"

namespace ombre {

// A plane with a normal of length one. The inner side has dot(normal, p) <= offset.
struct Plane {
  Vec3 normal;
  double offset = 0;
};

// The two ends of an edge.
using Edge3 = std::array<Vec3, 2>;

// A list that is computed from points, or what is wrong with the points, as text for a message. The order of the list
// depends on the points alone.
template <class T>
struct OfPoints {
  std::vector<T> list;
  std::string problem;
};

// False if this build lacks the library that computes hulls and edges.
bool knows_point_sets();

// Returns one plane for each face of the convex hull.
OfPoints<Plane> hull_planes(std::span<const Vec3> points);
// Returns the edges of the tetrahedra whose circumspheres contain no other point. If more than four points lie on a
// sphere, one of the possible triangulations is used.
OfPoints<Edge3> delaunay_edges(std::span<const Vec3> points);
// Returns the corners of those tetrahedra, by their numbers.
OfPoints<std::array<size_t, 4>> delaunay_tetrahedra(std::span<const Vec3> points);
// Returns the faces of those tetrahedra.
OfPoints<std::array<Vec3, 3>> delaunay_faces(std::span<const Vec3> points);
// Returns the edges on which three or more points are equally near and no other point is nearer. Edges that extend to
// infinity are left out, or are cut at the sides of `box` if it is given.
OfPoints<Edge3> voronoi_edges(std::span<const Vec3> points, const std::optional<Box>& box);

}  // namespace ombre
