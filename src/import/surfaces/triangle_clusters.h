// Clusters of eight neighbouring triangles, of which those too far from a point are excluded at once.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "import/surfaces/surface.h"

namespace ombre::importing {

// A scaling of a mesh into a cube of half-width one, for single precision.
struct Frame {
  Vec3 center;
  double scale = 1;

  explicit Frame(const Box& box);
  Vec3 operator()(Vec3 p) const { return scale * (p - center); }
};

// A cluster with an enclosing disc in the plane of each triangle. Balls would not be tight enough: seen from deep
// inside, many triangles are about as far away as the nearest. Numbers are rounded coordinates of the frame.
struct TriangleCluster {
  static constexpr size_t most = 8;
  using Row = std::array<float, most>;

  Row x{}, y{}, z{};                       // centres of the discs
  Row across_x{}, across_y{}, across_z{};  // normals of the discs; 0 if a triangle has no area, whose disc is a ball
  Row radius{};
  std::array<uint32_t, most> triangles{};
  uint32_t count = 0;
  std::array<float, 3> lo{}, hi{};  // box around the triangles

  // Returns bits; bit n is set if triangle n may be within `reach` of the point. `reach` must include a margin for
  // rounding of coordinates.
  uint32_t within(const std::array<float, 3>& point, float reach) const;
};

std::vector<TriangleCluster> cluster_triangles(const Surface& surface, const Frame& frame);

}  // namespace ombre::importing
