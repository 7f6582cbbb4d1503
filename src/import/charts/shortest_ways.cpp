#include "import/charts/shortest_ways.h"

#include <algorithm>
#include <cmath>

#include "base/math/box_tree.h"
#include "base/system/module_loader.h"
#include "base/text/error.h"
#include "import/charts/surface_patch.h"
#include "import/fields/triangle_distance.h"

namespace ombre::importing {
namespace {

constexpr Module ways_by_cgal{"ombre_flat_surfaces", "CGAL",         "distances along surfaces",
                              "libcgal-dev",         "OMBRE_SOLIDS", "use distance_to or point_distance"};

class GeodesicSource final : public program::FieldSource {
 public:
  GeodesicSource(std::string name, std::vector<Vec3> points, std::vector<Corners> triangles,
                 const std::vector<Vec3>& from, Hash content)
      : name_(std::move(name)), points_(std::move(points)), triangles_(std::move(triangles)), content_(content) {
    std::vector<Box> boxes;
    for (uint32_t n = 0; n < triangles_.size(); ++n) boxes.push_back(box_of(corners(n)));
    tree_ = BoxTree(boxes);
    std::vector<SurfacePoint> begins;
    for (const Vec3& p : from) begins.push_back(nearest(p));
    ways_ = shortest_ways(points_, triangles_, begins);
    find_greatest();
  }

  std::string name() const override { return name_; }
  Hash content() const override { return content_; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view channel_name) const override { return channel_name == "distance" ? 0 : -1; }
  // Distances jump where the nearest point does.
  Interval range(int, const Box&) const override { return {0, greatest_}; }
  double ops_of_sample(int) const override { return 2000; }

  double sample(int, Vec3 p) const override {
    return is_finite(p) ? std::min(ways_->length_to(nearest(p)), greatest_) : 0;
  }

 private:
  std::array<Vec3, 3> corners(uint32_t triangle) const {
    const auto& [a, b, c] = triangles_[triangle];
    return {points_[a], points_[b], points_[c]};
  }

  // Returns the nearest point, in the first of the nearest triangles.
  SurfacePoint nearest(Vec3 p) const {
    std::pair<double, uint32_t> best{Box::inf, 0};
    tree_.nearest(p, Box::inf, -1, [&](uint32_t n) {
      const double squared = squared_distance(p, corners(n));
      best = std::min(best, {squared, n});
      return std::sqrt(squared);
    });
    return {best.second, nearest_shares(corners(best.second), p)};
  }

  // A point of a triangle is at most an edge farther away than a corner.
  void find_greatest() {
    double farthest = 0, edge = 0;
    for (uint32_t n = 0; n < triangles_.size(); ++n) {
      const auto [a, b, c] = corners(n);
      edge = std::max({edge, length(b - a), length(c - b), length(a - c)});
      const double here = ways_->length_to({n, {1, 0, 0}});
      if (!std::isfinite(here))
        throw Error(Code::file_content, "no way along the surface leads from the given points to " + place_text(a) +
                                            ": it has several pieces; give a point on each, or leave pieces out");
      farthest = std::max(farthest, here);
    }
    greatest_ = farthest + edge;
  }

  std::string name_;
  std::vector<Vec3> points_;
  std::vector<Corners> triangles_;
  Hash content_;
  BoxTree tree_;
  std::unique_ptr<const ShortestWays> ways_;
  double greatest_ = 0;
};

}  // namespace

std::unique_ptr<const ShortestWays> shortest_ways(const std::vector<Vec3>& points,
                                                  const std::vector<std::array<uint32_t, 3>>& triangles,
                                                  const std::vector<SurfacePoint>& from) {
  static const auto find_ways = load_function<decltype(ombre_shortest_ways)>(ways_by_cgal, "ombre_shortest_ways");
  std::unique_ptr<const ShortestWays> ways;
  find_ways(points, triangles, from, ways);
  return ways;
}

program::SourceField make_geodesic_source(std::string name, std::vector<Vec3> points, std::vector<Corners> triangles,
                                          const std::vector<Vec3>& from, Hash content) {
  return std::make_shared<GeodesicSource>(std::move(name), std::move(points), std::move(triangles), from, content);
}

}  // namespace ombre::importing
