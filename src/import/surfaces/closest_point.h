// Distances from points to a mesh.
#pragma once

#include <functional>
#include <limits>
#include <memory>

#include "base/system/not_copied.h"
#include "import/surfaces/surface.h"

namespace ombre::importing {

// Returns true if this build supports distances (OMBRE_MESH_DISTANCE).
bool has_mesh_distance();

// Finds the triangles that may be nearest with Embree in single precision, with a margin for rounding, and computes
// their distances in double precision. Thread-safe once built.
class ClosestPoint : NotCopied {
 public:
  // Builds the tree. Throws Error if Embree cannot start. Requires has_mesh_distance().
  explicit ClosestPoint(SurfacePtr surface);
  ~ClosestPoint();

  static constexpr uint32_t none = ~uint32_t{0};
  struct Nearest {
    double distance_mm = std::numeric_limits<double>::infinity();  // unsigned
    uint32_t triangle = none;                                      // one of the nearest triangles, or none
  };
  // Returns the nearest triangle; the distance is infinite for points that are not finite. A triangle that may be near
  // speeds the search up as a guess; the distance does not depend on it.
  Nearest nearest(Vec3 p, uint32_t guess = none) const;

  // Calls `visit` with all triangles within the distance, in any order.
  void visit_within(Vec3 p, double distance_mm, const std::function<void(uint32_t triangle)>& visit) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace ombre::importing
