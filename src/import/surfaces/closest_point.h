// The distance from a point to a mesh.
#pragma once

#include <functional>
#include <limits>
#include <memory>

#include "import/surfaces/surface.h"

namespace ombre::importing {

// Whether this build has them (OMBRE_MESH_DISTANCE).
bool has_mesh_distance();

// Embree finds the triangles that may be closest, in single precision and with room for its
// rounding; their distances are double. Thread-safe once built.
class ClosestPoint {
 public:
  // Throws Error if Embree cannot start. Only where has_mesh_distance() is true.
  explicit ClosestPoint(SurfacePtr surface);
  ~ClosestPoint();
  ClosestPoint(const ClosestPoint&) = delete;
  ClosestPoint& operator=(const ClosestPoint&) = delete;

  static constexpr uint32_t none = ~uint32_t{0};
  struct Nearest {
    double distance_mm = std::numeric_limits<double>::infinity();  // without a sign
    uint32_t triangle = none;                                      // one of those that are so near, if any
  };
  // Infinite for points that are not finite. With a triangle that may be near as a guess, the distance is the same, and
  // comes sooner.
  Nearest nearest(Vec3 p, uint32_t guess = none) const;

  // Calls `visit` with all triangles that are no farther away, in any order.
  void visit_within(Vec3 p, double distance_mm, const std::function<void(uint32_t triangle)>& visit) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace ombre::importing
