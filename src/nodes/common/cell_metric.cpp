#include "nodes/common/cell_metric.h"

namespace ombre::nodes {
namespace {

Slope scaled(const Slope& a, Field factor) {
  return {product_without_zeros(a[0], factor), product_without_zeros(a[1], factor),
          product_without_zeros(a[2], factor)};
}

Slope difference(const Slope& a, const Slope& b) {
  const auto part = [&](size_t n) { return is_zero(b[n]) ? a[n] : a[n] - b[n]; };
  return {part(0), part(1), part(2)};
}

// Returns the place in its cell, from -0.5 to 0.5.
Field from_centre(Field at) { return limited(at - floor_of(at) - 0.5, -0.5, 0.5); }

std::array<Slope, 3> edges_of(const CellMap& map, const Point& p) {
  const Field zero = p.constant(0);
  if (map.is_perpendicular) {
    const Slope size = map.size_at(p);
    return {Slope{size[0], zero, zero}, Slope{zero, size[1], zero}, Slope{zero, zero, size[2]}};
  }
  const std::array<Slope, 3> rows{map.slope_at(0, p), map.slope_at(1, p), map.slope_at(2, p)};
  const Field share = p.constant(1) / dot_without_zeros(rows[0], cross_without_zeros(rows[1], rows[2]));
  const auto edge = [&](size_t n) { return scaled(cross_without_zeros(rows[(n + 1) % 3], rows[(n + 2) % 3]), share); };
  return {edge(0), edge(1), edge(2)};
}

}  // namespace

Slope folded_into_cell(const Slope& place) {
  return {abs(from_centre(place[0])), abs(from_centre(place[1])), abs(from_centre(place[2]))};
}

Slope from_centre_of_cell(const Slope& place) {
  return {from_centre(place[0]), from_centre(place[1]), from_centre(place[2])};
}

CellMetric CellMetric::at(const CellMap& map, const Point& p, bool is_folded) {
  CellMetric metric{edges_of(map, p)};
  if (!is_folded || map.is_perpendicular) return metric;
  const Slope place = map.place_at(p);
  const Field one = p.constant(1), minus_one = p.constant(-1);
  for (size_t n = 0; n < 3; ++n)
    metric.edges[n] = scaled(metric.edges[n], select(from_centre(place[n]) < 0, minus_one, one));
  return metric;
}

CellMetric CellMetric::along_w() const {
  const Slope& w = edges[2];
  const Field squared = dot_without_zeros(w, w), zero = squared.builder->constant(0);
  const auto across = [&](const Slope& edge) {
    const Field along = dot_without_zeros(edge, w);
    return is_zero(along) ? edge : difference(edge, scaled(w, along / squared));
  };
  return {{across(edges[0]), across(edges[1]), Slope{zero, zero, zero}}};
}

Slope CellMetric::way(const Slope& cells) const {
  const Field zero = cells[0].builder->constant(0);
  Slope sum{zero, zero, zero};
  for (size_t n = 0; n < 3; ++n)
    for (size_t axis = 0; axis < 3; ++axis)
      sum[axis] = sum_without_zeros(sum[axis], product_without_zeros(cells[n], edges[n][axis]));
  return sum;
}

Slope CellMetric::way(Vec3 cells) const {
  program::Builder& builder = *edges[0][0].builder;
  return way(Slope{builder.constant(cells.x), builder.constant(cells.y), builder.constant(cells.z)});
}

NearestOfStrut nearest_of_strut(const CellMetric& metric, const Slope& place, Vec3 start, Vec3 end) {
  const Slope from_start = metric.way(Slope{place[0] - start.x, place[1] - start.y, place[2] - start.z});
  const Slope whole = metric.way(end - start);
  const Field share = dot_without_zeros(from_start, whole) / dot_without_zeros(whole, whole);
  const Field along = limited(share, 0, 1);
  const Slope off = difference(from_start, scaled(whole, along));
  return {along, dot_without_zeros(off, off)};
}

}  // namespace ombre::nodes
