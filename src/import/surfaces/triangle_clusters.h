// Triangles in groups of eight neighbours, of which those that are too far from a point are found at once.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "import/surfaces/surface.h"

namespace ombre::importing {

// A mesh moved and scaled into a cube of half-width one, for numbers in single precision.
struct Frame {
  Vec3 center;
  double scale = 1;

  explicit Frame(const Box& box);
  Vec3 operator()(Vec3 p) const { return scale * (p - center); }
};

// Each triangle has a disc around it, in its plane. A ball would say too little: seen from deep inside, many triangles
// are about as far as the nearest. Numbers are those of the frame, rounded.
struct TriangleCluster {
  static constexpr size_t most = 8;
  using Row = std::array<float, most>;

  Row x{}, y{}, z{};                       // middles of discs
  Row across_x{}, across_y{}, across_z{};  // their normals; 0 where a triangle has no area, and its disc is a ball
  Row radius{};
  std::array<uint32_t, most> triangles{};
  uint32_t count = 0;
  std::array<float, 3> lo{}, hi{};  // encloses the triangles

  // Bit n is set where triangle n may be within `reach` of the point; `reach` has room for coordinates' rounding.
  uint32_t within(const std::array<float, 3>& point, float reach) const;
};

std::vector<TriangleCluster> cluster_triangles(const Surface& surface, const Frame& frame);

}  // namespace ombre::importing
