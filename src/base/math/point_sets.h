// Hulls, Delaunay and Voronoi edges of points in space.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/math/box.h"

namespace ombre {

// Behind it lies the side where dot(normal, p) <= offset; the normal has length one.
struct Plane {
  Vec3 normal;
  double offset = 0;
};

// Two points, each of a point set's or between them.
using Edge3 = std::array<Vec3, 2>;

// What was asked for, or what is wrong with the points, for people; in an order that follows from the points alone.
template <class T>
struct OfPoints {
  std::vector<T> list;
  std::string problem;
};

// False where this was built without the library that knows them.
bool knows_point_sets();

// The planes of the convex hull, one for each face.
OfPoints<Plane> hull_planes(std::span<const Vec3> points);
// Of the tetrahedra around whose corners no other point lies; where more than four points lie on a sphere, one way of
// cutting what is between them.
OfPoints<Edge3> delaunay_edges(std::span<const Vec3> points);
// Where three or more of the points are equally near and no other is nearer. Edges without an end are left out, but
// with a box all are there, cut at its sides.
OfPoints<Edge3> voronoi_edges(std::span<const Vec3> points, const std::optional<Box>& box);

}  // namespace ombre
