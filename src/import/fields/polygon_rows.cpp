#include "import/fields/polygon_rows.h"

#include <algorithm>
#include <cmath>

namespace ombre::importing {
namespace {

// Length of a step, relative to the farthest point, below which it is a rounding error.
constexpr double least_step = 1e-15;

Vec2 step_of(const Affine& source_from_index) { return {source_from_index.rows[0].x, source_from_index.rows[1].x}; }

double farthest(const Polygons& polygons) {
  double most = 0;
  for (const auto* rings : {&polygons.solid, &polygons.holes})
    for (const Ring& ring : *rings)
      for (const Vec2 p : ring) most = std::max({most, std::abs(p.x), std::abs(p.y)});
  return most;
}

bool is_no_step(const Polygons& polygons, Vec2 step) {
  return std::max(std::abs(step.x), std::abs(step.y)) <= least_step * farthest(polygons);
}

// Returns the first voxel that is not before a place, clamped to [0, width].
int64_t first_voxel(double place, int64_t width) {
  const double at = std::ceil(place);
  if (!(at > 0)) return 0;
  return at < static_cast<double>(width) ? static_cast<int64_t>(at) : width;
}

struct Change {
  int64_t voxel;
  int solid, holes;
};

}  // namespace

PolygonRows::PolygonRows(std::shared_ptr<const Polygons> polygons, const Affine& source_from_index)
    : polygons_(std::move(polygons)),
      source_from_index_(source_from_index),
      stays_in_place_(is_no_step(*polygons_, step_of(source_from_index))),
      crossings_(*polygons_, stays_in_place_ ? Vec2{1, 0} : step_of(source_from_index)) {}

void PolygonRows::layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
                        std::vector<std::vector<program::Span>>& rows) const {
  rows.resize(static_cast<size_t>(std::max<int64_t>(0, j_end - j_begin)));
  for (int64_t j = j_begin; j < j_end; ++j) {
    const Vec3 first = source_from_index_({0, static_cast<double>(j), static_cast<double>(k)});
    auto& spans = rows[static_cast<size_t>(j - j_begin)];
    spans.clear();
    row({first.x, first.y}, width, spans);
  }
}

void PolygonRows::row(Vec2 first, int64_t width, std::vector<program::Span>& spans) const {
  if (stays_in_place_) {
    if (width > 0 && crossings_.winding_at(first).is_inside()) spans.push_back({0, width});
    return;
  }
  static thread_local std::vector<Change> changes;
  changes.clear();
  const double begin = crossings_.place_of(first);
  crossings_.at(crossings_.line_of(first), [&](double place, int change, bool is_hole) {
    changes.push_back({first_voxel(place - begin, width), is_hole ? 0 : change, is_hole ? change : 0});
  });
  std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.voxel < b.voxel; });
  PolygonWinding winding;
  for (size_t n = 0; n < changes.size(); ++n) {
    winding.solid += changes[n].solid;
    winding.holes += changes[n].holes;
    const int64_t from = changes[n].voxel, to = n + 1 < changes.size() ? changes[n + 1].voxel : width;
    if (from >= to || !winding.is_inside()) continue;
    if (!spans.empty() && spans.back().end == from)
      spans.back().end = to;
    else
      spans.push_back({from, to});
  }
}

}  // namespace ombre::importing
