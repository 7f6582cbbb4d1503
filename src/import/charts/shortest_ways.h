// Shortest ways along surfaces of triangles, by a library in a separate module.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/math/vec.h"
#include "program/field_source.h"

namespace ombre::importing {

// A point of a surface: a triangle, and the shares of its corners, which add up to 1.
struct SurfacePoint {
  uint32_t triangle = 0;
  std::array<double, 3> shares{};
};

// The ways from some points along a surface. Thread-safe.
class ShortestWays {
 public:
  virtual ~ShortestWays() = default;
  // Returns the length in mm of the shortest way from the nearest of those points, which is exact but for rounding;
  // infinity if the surface leads from none of them there.
  virtual double length_to(const SurfacePoint& point) const = 0;
};

// Source: S. Xin and G. Wang, "Improving Chen and Han's algorithm on the discrete geodesic problem", ACM Transactions
// on Graphics 28, 2009. Throws Error if this build has no such library, or an edge has three triangles or two that face
// opposite sides.
std::unique_ptr<const ShortestWays> shortest_ways(const std::vector<Vec3>& points,
                                                  const std::vector<std::array<uint32_t, 3>>& triangles,
                                                  const std::vector<SurfacePoint>& from);

// Returns a source with the channel "distance": the length of the shortest way along the surface to the point of it
// that is nearest to a place. Ways begin at the points on the surface that are nearest to `from`. Each piece of the
// surface has such a point. `content` is the hash of all that the source is made of. Throws Error.
program::SourceField make_geodesic_source(std::string name, std::vector<Vec3> points,
                                          std::vector<std::array<uint32_t, 3>> triangles, const std::vector<Vec3>& from,
                                          Hash content);

}  // namespace ombre::importing

// Finds the ways; the function that the module exports.
extern "C" void ombre_shortest_ways(const std::vector<ombre::Vec3>& points,
                                    const std::vector<std::array<uint32_t, 3>>& triangles,
                                    const std::vector<ombre::importing::SurfacePoint>& from,
                                    std::unique_ptr<const ombre::importing::ShortestWays>& ways);
