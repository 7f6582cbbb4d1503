// Triangulates polygons.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/math/vec.h"

namespace ombre::formats {

using Corners = std::array<uint32_t, 3>;

// A triangulator that keeps its buffers from one polygon to the next.
class PolygonCutter {
 public:
  // Divides a polygon of n >= 3 corners into n - 2 triangles of corner numbers, with the polygon's orientation in its
  // plane (perpendicular to its area vector). Convex polygons become fans about corner 0, and concave ones do not fold.
  // A polygon that crosses itself also gives n - 2 triangles whose outer edges are its edges, so that a closed mesh
  // stays closed.
  const std::vector<Corners>& cut(std::span<const Vec3> corners);

 private:
  struct Point {
    double u = 0, v = 0;
    bool operator==(const Point&) const = default;
  };

  void flatten(std::span<const Vec3> corners);
  void find_reflex();
  bool is_convex(uint32_t corner) const;
  bool is_ear(uint32_t corner, size_t& tests_left) const;
  void clip(uint32_t corner);
  static double turn(Point a, Point b, Point c);

  std::vector<Point> points_;
  std::vector<uint32_t> next_, previous_;
  std::vector<uint32_t> reflex_;  // only reflex corners can lie in an ear
  std::vector<Corners> triangles_;
};

}  // namespace ombre::formats
