#include "import/fields/result_mesh.h"

#include <algorithm>

#include "base/system/assert.h"
#include "import/fields/triangle_distance.h"

namespace ombre::importing {
namespace {

// Greatest distance, in reference coordinates, by which rounding may put a place outside of the element that contains
// it.
constexpr double element_room = 1e-8;

Box box_of_element(const formats::Results& results, size_t element) {
  const ElementKind kind = results.kinds[element];
  std::array<double, most_element_nodes> along{};
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const size_t count = node_count(kind);
    for (size_t n = 0; n < count; ++n) along[n] = results.points[results.nodes[results.first[element] + n]][axis];
    const Interval range = field_bounds(kind, {along.data(), count});
    box.lo[axis] = range.lo;
    box.hi[axis] = range.hi;
  }
  return box.expanded(4 * element_room * length(box.size()));
}

Vec3 blended(const std::array<Vec3, 3>& corners, const std::array<double, 3>& shares) {
  return shares[0] * corners[0] + shares[1] * corners[1] + shares[2] * corners[2];
}

std::array<Vec3, 3> corners_of(const formats::Results& results, const BorderTriangle& triangle) {
  return {results.points[triangle.points[0]], results.points[triangle.points[1]], results.points[triangle.points[2]]};
}

// A side of an element, identified by the points of its corners.
struct NamedSide {
  std::array<uint32_t, 4> points{};
  uint32_t element = 0;
  uint8_t side = 0;
};

}  // namespace

ResultMesh::ResultMesh(formats::Results results) : results_(std::move(results)) {
  ASSERT(!results_.kinds.empty());
  boxes_.reserve(element_count());
  affine_.reserve(element_count());
  std::array<Vec3, most_element_nodes> points{};
  for (size_t n = 0; n < element_count(); ++n) {
    boxes_.push_back(box_of_element(results_, n));
    affine_.push_back(is_affine(results_.kinds[n], points_of(n, points)) ? 1 : 0);
    bounds_ = hull(bounds_, boxes_.back());
  }
  tree_ = BoxTree(boxes_);
}

bool ResultMesh::find_in(uint32_t element, Vec3 p, Vec3& at) const {
  std::array<Vec3, most_element_nodes> points;
  const std::span<const Vec3> own = points_of(element, points);
  const ElementKind kind = results_.kinds[element];
  return affine_[element] != 0 ? place_in_affine_element(kind, own, p, at) : place_in_element(kind, own, p, at);
}

std::span<const Vec3> ResultMesh::points_of(size_t element, std::span<Vec3> room) const {
  const auto numbers = nodes(element);
  for (size_t n = 0; n < numbers.size(); ++n) room[n] = results_.points[numbers[n]];
  return room.first(numbers.size());
}

std::optional<ElementPlace> ResultMesh::place(Vec3 p, const ElementPlace* guess) const {
  if (!is_finite(p)) return std::nullopt;
  Vec3 at;
  // A point well inside of an element lies in no other.
  if (guess && boxes_[guess->element].contains(p) && find_in(guess->element, p, at) &&
      is_in_element(results_.kinds[guess->element], at, -element_room))
    return ElementPlace{guess->element, at, 0};
  std::optional<ElementPlace> found;
  tree_.each_that_meets({p, p}, [&](uint32_t element) {
    if (found && found->element < element) return;
    if (!find_in(element, p, at) || !is_in_element(results_.kinds[element], at, element_room)) return;
    found = ElementPlace{element, clamped_to(results_.kinds[element], at), 0};
  });
  return found;
}

ElementPlace ResultMesh::nearest(Vec3 p, uint32_t* triangle_beside) const {
  const auto& triangles = border();
  if (triangles.empty()) return {0, middle_of(results_.kinds[0]), Box::inf};
  double best = Box::inf;
  uint32_t which = 0;
  // The bound is slightly larger, so that rounding hides no triangle that is equally near.
  const auto distance = [&](uint32_t n) {
    constexpr double rounding = 1e-14;
    const auto corners = corners_of(results_, triangles[n]);
    const double here = length(p - blended(corners, nearest_shares(corners, p)));
    if (here < best || (here == best && n < which)) {
      best = here;
      which = n;
    }
    return here * (1 + rounding);
  };
  const double reach = triangle_beside && *triangle_beside < triangles.size() ? distance(*triangle_beside) : Box::inf;
  border_tree_.nearest(p, reach, -1, distance);
  if (triangle_beside) *triangle_beside = which;
  const BorderTriangle& triangle = triangles[which];
  const auto shares = nearest_shares(corners_of(results_, triangle), p);
  return {triangle.element, clamped_to(results_.kinds[triangle.element], blended(triangle.at, shares)), best};
}

const std::vector<BorderTriangle>& ResultMesh::border() const {
  std::call_once(border_made_, [this] { make_border(); });
  return border_;
}

void ResultMesh::make_border() const {
  std::vector<NamedSide> sides;
  for (uint32_t element = 0; element < element_count(); ++element) {
    const auto& own = sides_of(results_.kinds[element]);
    for (size_t n = 0; n < own.size(); ++n) {
      NamedSide side{{UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX}, element, static_cast<uint8_t>(n)};
      for (size_t c = 0; c < own[n].corners.size(); ++c) side.points[c] = nodes(element)[own[n].corners[c]];
      std::ranges::sort(side.points);
      sides.push_back(side);
    }
  }
  std::ranges::sort(sides, [](const NamedSide& a, const NamedSide& b) {
    return a.points != b.points ? a.points < b.points : a.element < b.element;
  });
  std::vector<NamedSide> alone;
  for (size_t n = 0; n < sides.size(); ++n) {
    const bool is_shared = (n > 0 && sides[n - 1].points == sides[n].points) ||
                           (n + 1 < sides.size() && sides[n + 1].points == sides[n].points);
    if (!is_shared) alone.push_back(sides[n]);
  }
  std::ranges::sort(alone, [](const NamedSide& a, const NamedSide& b) {
    return a.element != b.element ? a.element < b.element : a.side < b.side;
  });
  std::vector<Box> boxes;
  for (const NamedSide& side : alone)
    for (const auto& corners : sides_of(results_.kinds[side.element])[side.side].triangles) {
      BorderTriangle triangle{side.element, {}, {}};
      for (size_t c = 0; c < 3; ++c) {
        triangle.points[c] = nodes(side.element)[corners[c]];
        triangle.at[c] = node_places(results_.kinds[side.element])[corners[c]];
      }
      boxes.push_back(box_of(corners_of(results_, triangle)));
      border_.push_back(triangle);
    }
  border_tree_ = BoxTree(boxes);
}

double ResultMesh::value(const formats::ResultField& field, size_t component, const ElementPlace& place) const {
  Weights weights{};
  if (!field.is_of_elements) find_weights(place, weights);
  return value(field, component, place.element, weights);
}

void ResultMesh::find_weights(const ElementPlace& place, Weights& weights) const {
  shape_weights(results_.kinds[place.element], place.at, weights);
}

double ResultMesh::value(const formats::ResultField& field, size_t component, size_t element,
                         const Weights& weights) const {
  if (field.is_of_elements) return field.values[element * field.components + component];
  const auto numbers = nodes(element);
  double sum = 0;
  for (size_t n = 0; n < numbers.size(); ++n)
    sum += weights[n] * field.values[numbers[n] * field.components + component];
  return sum;
}

Interval ResultMesh::value_bounds(const formats::ResultField& field, size_t component, size_t element) const {
  if (field.is_of_elements) return Interval(field.values[element * field.components + component]);
  std::array<double, most_element_nodes> values{};
  const auto numbers = nodes(element);
  for (size_t n = 0; n < numbers.size(); ++n) values[n] = field.values[numbers[n] * field.components + component];
  return field_bounds(results_.kinds[element], {values.data(), numbers.size()});
}

size_t ResultMesh::bytes() const {
  // estimates: per element for boxes, tree and nodes; per point for the border
  constexpr size_t per_element = 150, per_point = 24;
  size_t bytes = per_element * element_count() + per_point * results_.points.size();
  for (const auto& field : results_.fields) bytes += field.values.size() * sizeof(double);
  return bytes;
}

}  // namespace ombre::importing
