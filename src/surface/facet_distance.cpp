#include "surface/facet_distance.h"

#include <algorithm>
#include <cmath>

#include "base/tasks.h"
#include "surface/box_tree.h"
#include "surface/surface_distance.h"

namespace ombre::surface {
namespace {

// Calls work(begin, end) for pieces of what is counted.
template <class Work>
void in_pieces(size_t count, int threads, const Work& work) {
  constexpr size_t piece = 1024;
  run_parallel((count + piece - 1) / piece, threads,
               [&](size_t p) { work(p * piece, std::min((p + 1) * piece, count)); });
}

BoxTree tree_around(const std::vector<Vec3>& points, double reach_mm) {
  std::vector<Box> boxes;
  boxes.reserve(points.size());
  for (const Vec3& point : points) boxes.push_back(Box{point, point}.expanded(reach_mm));
  return BoxTree(boxes);
}

// Quads that may have facets within reach of a point, with their boxes.
class NearQuads {
 public:
  NearQuads(const std::vector<Vec3>& points, const QuadSurface& surface, double reach_mm, int threads)
      : surface_(surface) {
    const BoxTree around = tree_around(points, reach_mm);
    std::vector<Box> boxes(surface.quads());
    in_pieces(boxes.size(), threads, [&](size_t begin, size_t end) {
      for (size_t quad = begin; quad < end; ++quad) {
        const Box box = box_of_quad(static_cast<uint32_t>(quad));
        if (!box.is_empty() && around.meets_any(box)) boxes[quad] = box;
      }
    });
    std::vector<Box> kept;
    for (uint32_t quad = 0; quad < boxes.size(); ++quad) {
      if (boxes[quad].is_empty()) continue;
      quads_.push_back(quad);
      kept.push_back(boxes[quad]);
    }
    tree_ = BoxTree(kept);
  }

  double distance(Vec3 point, double reach_mm, double enough_mm) const {
    return tree_.nearest(point, reach_mm, enough_mm, [&](uint32_t n) {
      double nearest = HUGE_VAL;
      for (const Triangle& triangle : surface_.triangles(quads_[n]))
        nearest = std::min(nearest, distance_to_triangle(point, surface_.corners(triangle)));
      return nearest;
    });
  }

 private:
  Box box_of_quad(uint32_t quad) const {
    Box box;
    for (const Triangle& triangle : surface_.triangles(quad)) box = hull(box, box_of(surface_.corners(triangle)));
    return box;
  }

  const QuadSurface& surface_;
  std::vector<uint32_t> quads_;
  BoxTree tree_;
};

std::vector<double> distances(const std::vector<Vec3>& points, const QuadSurface& surface, double reach_mm,
                              double enough_mm, int threads) {
  if (points.empty()) return {};
  const NearQuads near(points, surface, reach_mm, threads);
  std::vector<double> distances(points.size());
  in_pieces(points.size(), threads, [&](size_t begin, size_t end) {
    for (size_t n = begin; n < end; ++n) distances[n] = near.distance(points[n], reach_mm, enough_mm);
  });
  return distances;
}

}  // namespace

std::vector<double> distances_to_facets(const std::vector<Vec3>& points, const QuadSurface& surface, double reach_mm,
                                        int threads) {
  return distances(points, surface, reach_mm, 0, threads);
}

std::vector<bool> are_near_facets(const std::vector<Vec3>& points, const QuadSurface& surface, double reach_mm,
                                  int threads) {
  const std::vector<double> found = distances(points, surface, reach_mm, reach_mm, threads);
  std::vector<bool> near;
  near.reserve(points.size());
  for (const double distance : found) near.push_back(distance <= reach_mm);
  return near;
}

}  // namespace ombre::surface
