// Winding numbers of a mesh around points.
#include "import/surfaces/point_winding.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ombre::importing {
namespace {

constexpr double most_cells_per_axis = 1024;

DyadicBins bin_by_yz(const Surface& surface) {
  std::vector<DyadicBins::Rectangle> rectangles;
  rectangles.reserve(surface.triangles.size());
  for (uint32_t i = 0; i < surface.triangles.size(); ++i) {
    const auto [a, b, c] = surface.corners(i);
    rectangles.push_back({{std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
                          {std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})},
                          i});
  }
  const double cells = std::sqrt(static_cast<double>(surface.triangles.size())) + 1;
  const auto per_axis = static_cast<uint32_t>(std::min(cells, most_cells_per_axis));
  return {rectangles, {per_axis, per_axis}};
}

// Returns a float below all numbers, by more than crossings are rounded.
float below(std::initializer_list<double> values) {
  return std::nextafter(static_cast<float>(std::min(values)), -std::numeric_limits<float>::infinity());
}
float above(std::initializer_list<double> values) {
  return std::nextafter(static_cast<float>(std::max(values)), std::numeric_limits<float>::infinity());
}

}  // namespace

PointWinding::PointWinding(SurfacePtr surface) : surface_(std::move(surface)), by_yz_(bin_by_yz(*surface_)) {
  reaches_.reserve(surface_->triangles.size());
  for (uint32_t i = 0; i < surface_->triangles.size(); ++i) {
    const auto [a, b, c] = surface_->corners(i);
    reaches_.push_back({below({a.x, b.x, c.x}), below({a.y, b.y, c.y}), above({a.y, b.y, c.y}), below({a.z, b.z, c.z}),
                        above({a.z, b.z, c.z})});
  }
}

int64_t PointWinding::at(Vec3 p) const {
  int64_t sum = 0;
  by_yz_.at(p.y, p.z, [&](uint32_t id) { sum += crossing(id, p).way; });
  return sum;
}

}  // namespace ombre::importing
