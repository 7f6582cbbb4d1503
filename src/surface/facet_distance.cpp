#include "surface/facet_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/tasks.h"
#include "surface/box_tree.h"
#include "surface/surface_distance.h"

namespace ombre::surface {

std::vector<double> distances_to_facets(const std::vector<Vec3>& points, const QuadSurface& surface, double reach_mm,
                                        int threads) {
  if (points.empty()) return {};
  std::vector<Box> boxes;
  boxes.reserve(points.size());
  for (const Vec3& point : points) boxes.push_back(Box{point, point}.expanded(reach_mm));
  const BoxTree tree(boxes);

  constexpr size_t piece = 4096;
  std::vector<std::vector<std::pair<uint32_t, double>>> found((surface.quads() + piece - 1) / piece);
  run_parallel(found.size(), threads, [&](size_t p) {
    const auto end = static_cast<uint32_t>(std::min((p + 1) * piece, surface.quads()));
    for (auto quad = static_cast<uint32_t>(p * piece); quad < end; ++quad)
      for (const Triangle& triangle : surface.triangles(quad)) {
        const std::array<Vec3, 3> corners = surface.corners(triangle);
        tree.each_that_meets(box_of(corners), [&](uint32_t n) {
          const double distance = distance_to_triangle(points[n], corners);
          if (distance <= reach_mm) found[p].emplace_back(n, distance);
        });
      }
  });
  std::vector<double> distances(points.size(), HUGE_VAL);
  for (const auto& part : found)
    for (const auto& [n, distance] : part) distances[n] = std::min(distances[n], distance);
  return distances;
}

}  // namespace ombre::surface
