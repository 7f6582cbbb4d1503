#include "import/fields/element_shapes.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace ombre::importing {
namespace {

using Pair = std::pair<uint8_t, uint8_t>;

// Pairs of corners between which quadratic elements have a node.
constexpr std::array<Pair, 6> tetrahedron_edges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<Pair, 12> brick_edges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

constexpr std::array<Vec3, 10> tetrahedron_places{{{0, 0, 0},
                                                   {1, 0, 0},
                                                   {0, 1, 0},
                                                   {0, 0, 1},
                                                   {0.5, 0, 0},
                                                   {0.5, 0.5, 0},
                                                   {0, 0.5, 0},
                                                   {0, 0, 0.5},
                                                   {0.5, 0, 0.5},
                                                   {0, 0.5, 0.5}}};
constexpr std::array<Vec3, 20> brick_places{{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1},
                                             {1, -1, 1},   {1, 1, 1},   {-1, 1, 1}, {0, -1, -1}, {1, 0, -1},
                                             {0, 1, -1},   {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},   {0, 1, 1},
                                             {-1, 0, 1},   {-1, -1, 0}, {1, -1, 0}, {1, 1, 0},   {-1, 1, 0}}};

constexpr std::array<Vec3, 6> wedge_places{{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
constexpr std::array<Vec3, 5> pyramid_places{{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {0, 0, 1}}};

// Returns the barycentric coordinates of a point in a tetrahedron.
std::array<double, 4> shares(Vec3 at) { return {1 - at.x - at.y - at.z, at.x, at.y, at.z}; }
constexpr std::array<Vec3, 4> share_slopes{{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

// The weights of a wedge's nodes are those of a triangle's corners in x and y, times those of a line's ends in z.
std::array<double, 3> triangle_shares(Vec3 at) { return {1 - at.x - at.y, at.x, at.y}; }
constexpr std::array<Vec3, 3> triangle_slopes{{{-1, -1, 0}, {1, 0, 0}, {0, 1, 0}}};
double end_share(Vec3 at, Vec3 node) { return 0.5 * (1 + at.z * node.z); }

double wedge_weight(Vec3 at, size_t n) { return triangle_shares(at)[n % 3] * end_share(at, wedge_places[n]); }
Vec3 wedge_slope(Vec3 at, size_t n) {
  Vec3 slope = end_share(at, wedge_places[n]) * triangle_slopes[n % 3];
  slope.z = 0.5 * wedge_places[n].z * triangle_shares(at)[n % 3];
  return slope;
}

// Returns 1 + a*b for each axis, for a node at b.
Vec3 factors(Vec3 at, Vec3 node) { return {1 + at.x * node.x, 1 + at.y * node.y, 1 + at.z * node.z}; }
double product(Vec3 f) { return f.x * f.y * f.z; }
// Returns the gradient of the product of three factors, one for each axis.
Vec3 product_slope(Vec3 f, Vec3 node) { return {node.x * f.y * f.z, node.y * f.x * f.z, node.z * f.x * f.y}; }
// Returns the axis along which a node lies between corners: its factor there is 1 - a*a.
int free_axis(Vec3 node) { return node.x == 0 ? 0 : node.y == 0 ? 1 : 2; }

double pyramid_weight(Vec3 at, size_t n) {
  return n == 4 ? end_share(at, {0, 0, 1}) : 0.125 * product(factors(at, pyramid_places[n]));
}
Vec3 pyramid_slope(Vec3 at, size_t n) {
  if (n == 4) return {0, 0, 0.5};
  return 0.125 * product_slope(factors(at, pyramid_places[n]), pyramid_places[n]);
}

double brick20_weight(Vec3 at, size_t n) {
  const Vec3 node = brick_places[n];
  Vec3 f = factors(at, node);
  if (n < 8) return 0.125 * product(f) * (dot(at, node) - 2);
  const int axis = free_axis(node);
  f[axis] = 1 - at[axis] * at[axis];
  return 0.25 * product(f);
}

Vec3 brick20_slope(Vec3 at, size_t n) {
  const Vec3 node = brick_places[n];
  Vec3 f = factors(at, node);
  if (n < 8) return 0.125 * ((dot(at, node) - 2) * product_slope(f, node) + product(f) * node);
  const int axis = free_axis(node);
  f[axis] = 1 - at[axis] * at[axis];
  Vec3 along = node;
  along[axis] = -2 * at[axis];
  return 0.25 * product_slope(f, along);
}

Interval range_of(std::span<const double> values) {
  const auto [least, greatest] = std::ranges::minmax(values);
  return {least, greatest};
}

// Returns the control value of a quadratic Bezier curve that takes the value `middle` halfway between its ends.
double control(double a, double middle, double b) { return 2 * middle - 0.5 * (a + b); }

Interval tetrahedron10_bounds(std::span<const double> values) {
  std::array<double, 10> controls{};
  std::copy(values.begin(), values.end(), controls.begin());
  for (size_t n = 0; n < tetrahedron_edges.size(); ++n)
    controls[4 + n] = control(values[tetrahedron_edges[n].first], values[4 + n], values[tetrahedron_edges[n].second]);
  return range_of(controls);
}

// The element's polynomial is quadratic along each axis, so 27 values determine it.
Interval brick20_bounds(std::span<const double> values) {
  std::array<double, 27> grid{};
  std::array<double, 20> weights{};
  for (size_t n = 0; n < grid.size(); ++n) {
    const size_t i = n % 3, j = n / 3 % 3, k = n / 9;
    const Vec3 at{static_cast<double>(i) - 1, static_cast<double>(j) - 1, static_cast<double>(k) - 1};
    shape_weights(ElementKind::brick20, at, weights);
    for (size_t c = 0; c < weights.size(); ++c) grid[n] += weights[c] * values[c];
  }
  for (const size_t step : {size_t{1}, size_t{3}, size_t{9}})
    for (size_t n = 0; n < grid.size(); ++n)
      if (n / step % 3 == 1) grid[n] = control(grid[n - step], grid[n], grid[n + step]);
  return range_of(grid);
}

using Sides = std::vector<ElementSide>;

// Returns the node between two corners.
template <size_t N>
uint8_t between(const std::array<Pair, N>& edges, size_t corners, uint8_t a, uint8_t b) {
  for (size_t n = 0; n < N; ++n)
    if (edges[n] == Pair{a, b} || edges[n] == Pair{b, a}) return static_cast<uint8_t>(corners + n);
  return a;
}

constexpr std::array<std::array<uint8_t, 3>, 4> tetrahedron_sides{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
constexpr std::array<std::array<uint8_t, 4>, 6> brick_sides{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

Sides make_tetrahedron_sides(bool is_quadratic) {
  Sides sides;
  for (const auto& [a, b, c] : tetrahedron_sides) {
    ElementSide side{{a, b, c}, {{a, b, c}}};
    if (is_quadratic) {
      const uint8_t ab = between(tetrahedron_edges, 4, a, b), bc = between(tetrahedron_edges, 4, b, c),
                    ca = between(tetrahedron_edges, 4, c, a);
      side.triangles = {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}};
    }
    sides.push_back(std::move(side));
  }
  return sides;
}

Sides make_brick_sides(bool is_quadratic) {
  Sides sides;
  for (const auto& [a, b, c, d] : brick_sides) {
    ElementSide side{{a, b, c, d}, {{a, b, c}, {a, c, d}}};
    if (is_quadratic) {
      const uint8_t ab = between(brick_edges, 8, a, b), bc = between(brick_edges, 8, b, c),
                    cd = between(brick_edges, 8, c, d), da = between(brick_edges, 8, d, a);
      side.triangles = {{a, ab, da}, {b, bc, ab}, {c, cd, bc}, {d, da, cd}, {ab, bc, cd}, {ab, cd, da}};
    }
    sides.push_back(std::move(side));
  }
  return sides;
}

// Makes sides of elements without nodes between corners; sides of four corners are cut along the first diagonal.
Sides make_flat_sides(const std::vector<std::vector<uint8_t>>& corners) {
  Sides sides;
  for (const std::vector<uint8_t>& side : corners) {
    sides.push_back({side, {{side[0], side[1], side[2]}}});
    if (side.size() == 4) sides.back().triangles.push_back({side[0], side[2], side[3]});
  }
  return sides;
}

// Solves a linear system of three equations with these columns. Returns false if the columns are linearly dependent.
bool solve(const std::array<Vec3, 3>& columns, Vec3 right, Vec3& solution) {
  const Vec3 normal = cross(columns[1], columns[2]);
  const double volume = dot(columns[0], normal);
  if (!(std::abs(volume) > 0)) return false;
  solution = (1 / volume) * Vec3{dot(right, normal), dot(columns[0], cross(right, columns[2])),
                                 dot(columns[0], cross(columns[1], right))};
  return is_finite(solution);
}

}  // namespace

void shape_weights(ElementKind kind, Vec3 at, std::span<double> weights) {
  if (is_tetrahedron(kind)) {
    const auto share = shares(at);
    const bool is_linear = kind == ElementKind::tetrahedron4;
    for (size_t n = 0; n < 4; ++n) weights[n] = is_linear ? share[n] : share[n] * (2 * share[n] - 1);
    for (size_t n = 0; n < tetrahedron_edges.size() && !is_linear; ++n)
      weights[4 + n] = 4 * share[tetrahedron_edges[n].first] * share[tetrahedron_edges[n].second];
    return;
  }
  for (size_t n = 0; n < node_count(kind); ++n)
    weights[n] = kind == ElementKind::brick8     ? 0.125 * product(factors(at, brick_places[n]))
                 : kind == ElementKind::wedge6   ? wedge_weight(at, n)
                 : kind == ElementKind::pyramid5 ? pyramid_weight(at, n)
                                                 : brick20_weight(at, n);
}

void shape_slopes(ElementKind kind, Vec3 at, std::span<Vec3> slopes) {
  if (is_tetrahedron(kind)) {
    const auto share = shares(at);
    const bool is_linear = kind == ElementKind::tetrahedron4;
    for (size_t n = 0; n < 4; ++n) slopes[n] = (is_linear ? 1 : 4 * share[n] - 1) * share_slopes[n];
    for (size_t n = 0; n < tetrahedron_edges.size() && !is_linear; ++n) {
      const auto [a, b] = tetrahedron_edges[n];
      slopes[4 + n] = 4 * (share[b] * share_slopes[a] + share[a] * share_slopes[b]);
    }
    return;
  }
  for (size_t n = 0; n < node_count(kind); ++n)
    slopes[n] = kind == ElementKind::brick8     ? 0.125 * product_slope(factors(at, brick_places[n]), brick_places[n])
                : kind == ElementKind::wedge6   ? wedge_slope(at, n)
                : kind == ElementKind::pyramid5 ? pyramid_slope(at, n)
                                                : brick20_slope(at, n);
}

Vec3 middle_of(ElementKind kind) {
  if (kind == ElementKind::wedge6) return {1.0 / 3, 1.0 / 3, 0};
  return is_tetrahedron(kind) ? Vec3{0.25, 0.25, 0.25} : Vec3{};
}

bool is_in_element(ElementKind kind, Vec3 at, double room) {
  if (is_tetrahedron(kind)) return std::ranges::all_of(shares(at), [&](double share) { return share >= -room; });
  if (kind == ElementKind::wedge6)
    return std::abs(at.z) <= 1 + room && std::ranges::all_of(triangle_shares(at), [&](double s) { return s >= -room; });
  return std::abs(at.x) <= 1 + room && std::abs(at.y) <= 1 + room && std::abs(at.z) <= 1 + room;
}

Vec3 clamped_to(ElementKind kind, Vec3 at) {
  if (kind == ElementKind::wedge6) {
    const double x = std::max(at.x, 0.0), y = std::max(at.y, 0.0), sum = std::max(x + y, 1.0);
    return {x / sum, y / sum, std::clamp(at.z, -1.0, 1.0)};
  }
  if (!is_tetrahedron(kind))
    return {std::clamp(at.x, -1.0, 1.0), std::clamp(at.y, -1.0, 1.0), std::clamp(at.z, -1.0, 1.0)};
  const Vec3 kept{std::max(at.x, 0.0), std::max(at.y, 0.0), std::max(at.z, 0.0)};
  const double sum = kept.x + kept.y + kept.z;
  return sum > 1 ? (1 / sum) * kept : kept;
}

std::span<const Vec3> node_places(ElementKind kind) {
  if (kind == ElementKind::wedge6) return wedge_places;
  if (kind == ElementKind::pyramid5) return pyramid_places;
  const std::span<const Vec3> all = is_tetrahedron(kind) ? std::span<const Vec3>(tetrahedron_places) : brick_places;
  return all.first(node_count(kind));
}

Interval field_bounds(ElementKind kind, std::span<const double> values) {
  if (kind == ElementKind::tetrahedron10) return tetrahedron10_bounds(values);
  if (kind == ElementKind::brick20) return brick20_bounds(values);
  return range_of(values);
}

bool place_in_element(ElementKind kind, std::span<const Vec3> nodes, Vec3 target, Vec3& at) {
  constexpr int most_steps = 30;
  constexpr double enough = 1e-13, far = 8;
  std::array<double, most_element_nodes> weights{};
  std::array<Vec3, most_element_nodes> slopes{};
  at = middle_of(kind);
  for (int step = 0; step < most_steps; ++step) {
    shape_weights(kind, at, weights);
    shape_slopes(kind, at, slopes);
    Vec3 here;
    std::array<Vec3, 3> columns{};
    for (size_t n = 0; n < nodes.size(); ++n) {
      here = here + weights[n] * nodes[n];
      for (size_t axis = 0; axis < 3; ++axis)
        columns[axis] = columns[axis] + slopes[n][static_cast<int>(axis)] * nodes[n];
    }
    Vec3 change;
    if (!solve(columns, target - here, change)) break;  // as at the tip of a pyramid
    at = at + change;
    if (kind == ElementKind::tetrahedron4) return true;
    const double size = length(change);
    if (size < enough) return true;
    if (!(length(at) < far)) return false;
  }
  // Rounding prevents a closer result.
  shape_weights(kind, at, weights);
  Vec3 here;
  double extent = 0;
  for (size_t n = 0; n < nodes.size(); ++n) {
    here = here + weights[n] * nodes[n];
    extent = std::max(extent, length(nodes[n] - nodes[0]));
  }
  return length(target - here) <= 1e-9 * extent;
}

namespace {

// Returns the neighbours of the first node along each reference axis.
std::array<size_t, 3> nodes_along_axes(ElementKind kind) {
  if (is_tetrahedron(kind) || kind == ElementKind::wedge6) return {1, 2, 3};
  return {1, 3, 4};
}

}  // namespace

bool is_affine(ElementKind kind, std::span<const Vec3> nodes) {
  if (kind == ElementKind::pyramid5) return false;
  constexpr double rounding = 1e-13;
  const auto along = nodes_along_axes(kind);
  const std::span<const Vec3> places = node_places(kind);
  // The tolerance includes rounding of the coordinates, which grows with their distance from the origin.
  double extent = length(nodes[0]);
  for (const Vec3& node : nodes) extent = std::max(extent, length(node - nodes[0]));
  for (size_t n = 0; n < nodes.size(); ++n) {
    Vec3 expected = nodes[0];
    for (int axis = 0; axis < 3; ++axis) {
      const size_t neighbour = along[static_cast<size_t>(axis)];
      const double step = places[neighbour][axis] - places[0][axis];
      expected = expected + ((places[n][axis] - places[0][axis]) / step) * (nodes[neighbour] - nodes[0]);
    }
    if (!(length(nodes[n] - expected) <= rounding * extent)) return false;
  }
  return true;
}

bool place_in_affine_element(ElementKind kind, std::span<const Vec3> nodes, Vec3 target, Vec3& at) {
  const auto along = nodes_along_axes(kind);
  std::array<Vec3, 3> edges{};
  for (size_t axis = 0; axis < 3; ++axis) edges[axis] = nodes[along[axis]] - nodes[0];
  Vec3 shares;
  if (!solve(edges, target - nodes[0], shares)) return false;
  at = is_tetrahedron(kind) ? shares : 2 * shares - Vec3{1, 1, 1};
  if (kind == ElementKind::wedge6) at = {shares.x, shares.y, 2 * shares.z - 1};
  return true;
}

const std::vector<ElementSide>& sides_of(ElementKind kind) {
  static const std::array<Sides, formats::element_kinds> all{
      make_tetrahedron_sides(false),
      make_tetrahedron_sides(true),
      make_brick_sides(false),
      make_brick_sides(true),
      make_flat_sides({{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}),
      make_flat_sides({{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}})};
  return all[static_cast<size_t>(kind)];
}

}  // namespace ombre::importing
