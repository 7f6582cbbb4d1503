#include "surface/mesh/facet_distance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/math/box_tree.h"
#include "surface/mesh/surface_distance.h"

namespace ombre::surface {
namespace {

// Number of items per parallel piece.
constexpr size_t piece = 1024;

std::vector<uint32_t> all_quads(const QuadSurface& surface) {
  std::vector<uint32_t> quads(surface.quads());
  std::iota(quads.begin(), quads.end(), 0U);
  return quads;
}

BoxTree tree_around(const std::vector<Ball>& balls) {
  std::vector<Box> boxes;
  boxes.reserve(balls.size());
  for (const Ball& ball : balls) boxes.push_back(Box{ball.center, ball.center}.expanded(ball.radius_mm));
  return BoxTree(boxes);
}

// The quads that may meet any of the balls, in a tree of their boxes.
class NearQuads {
 public:
  NearQuads(const std::vector<Ball>& balls, const QuadSurface& surface, const std::vector<uint32_t>& quads,
            const Workers& workers)
      : surface_(surface) {
    const BoxTree around = tree_around(balls);
    std::vector<Box> boxes(quads.size());
    workers.in_pieces(boxes.size(), piece, [&](size_t begin, size_t end) {
      for (size_t n = begin; n < end; ++n) {
        const Box box = box_of_quad(quads[n]);
        if (!box.is_empty() && around.meets_any(box)) boxes[n] = box;
      }
    });
    std::vector<Box> kept;
    for (size_t n = 0; n < boxes.size(); ++n) {
      if (boxes[n].is_empty()) continue;
      quads_.push_back(quads[n]);
      kept.push_back(boxes[n]);
    }
    tree_ = BoxTree(kept);
  }

  // Returns the distance to the nearest triangle inside the ball, or any distance of at most `enough_mm`.
  double distance(const Ball& ball, double enough_mm) const {
    return tree_.nearest(ball.center, ball.radius_mm, enough_mm, [&](uint32_t n) {
      double nearest = HUGE_VAL;
      for (const Triangle& triangle : surface_.triangles(quads_[n]))
        nearest = std::min(nearest, distance_to_triangle(ball.center, surface_.corners(triangle)));
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

// Returns for each ball the distance to the nearest triangle in it, or any distance of at most `enough` times the
// radius.
std::vector<double> distances(const std::vector<Ball>& balls, const QuadSurface& surface,
                              const std::vector<uint32_t>& quads, double enough, const Workers& workers) {
  if (balls.empty() || quads.empty()) return std::vector<double>(balls.size(), HUGE_VAL);
  const NearQuads near(balls, surface, quads, workers);
  std::vector<double> distances(balls.size());
  workers.in_pieces(balls.size(), piece, [&](size_t begin, size_t end) {
    for (size_t n = begin; n < end; ++n) distances[n] = near.distance(balls[n], enough * balls[n].radius_mm);
  });
  return distances;
}

}  // namespace

std::vector<double> distances_to_facets(const std::vector<Vec3>& points, const QuadSurface& surface, double reach_mm,
                                        const Workers& workers) {
  std::vector<Ball> balls;
  balls.reserve(points.size());
  for (const Vec3& point : points) balls.push_back({point, reach_mm});
  return distances(balls, surface, all_quads(surface), 0, workers);
}

std::vector<bool> meet_facets(const std::vector<Ball>& balls, const QuadSurface& surface, const Workers& workers) {
  return meet_facets(balls, surface, all_quads(surface), workers);
}

std::vector<bool> meet_facets(const std::vector<Ball>& balls, const QuadSurface& surface,
                              const std::vector<uint32_t>& quads, const Workers& workers) {
  const std::vector<double> found = distances(balls, surface, quads, 1, workers);
  std::vector<bool> meet;
  meet.reserve(balls.size());
  for (size_t n = 0; n < balls.size(); ++n) meet.push_back(found[n] <= balls[n].radius_mm);
  return meet;
}

}  // namespace ombre::surface
