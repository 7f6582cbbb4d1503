// Tests of roofs. The area of a region shrunk by t, integrated over t, is the volume of its roof.
#include <numbers>

#include "solids/test_trees.h"

namespace ombre::solids {
namespace {

constexpr RoofMethod distance_roof = RoofMethod::distance, straight_roof = RoofMethod::straight;

class Roofs : public KernelTest {};

TreePtr roof(RoofMethod method, Children children, Fragments fragments = {}) {
  return node(Roof{method, 1, fragments}, std::move(children));
}

struct Measures {
  double volume = 0, height = 0;
  std::string messages;
};

Measures roof_measures(const TreePtr& tree) {
  Diagnostics messages;
  Measures result;
  for (const Piece& piece : evaluate(tree, {}, messages)) {
    const TriangleMesh& mesh = piece.solid()->mesh();
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_EQ(piece.solid()->flaw(), Flaw::none);
    result.volume += volume_of(mesh);
    result.height = std::max(result.height, bounds_of(mesh).hi.z);
    EXPECT_EQ(bounds_of(mesh).lo.z, 0);
  }
  for (const Diagnostic& message : messages.list()) result.messages += message.message + "\n";
  return result;
}

void expect_roof(const TreePtr& tree, double volume, double height, double tolerance = 1e-7) {
  const Measures found = roof_measures(tree);
  EXPECT_NEAR(found.volume, volume, tolerance * volume);
  EXPECT_NEAR(found.height, height, tolerance * height);
  EXPECT_EQ(found.messages, "");
}

TEST_F(Roofs, OfRectangles) {
  for (const RoofMethod method : {distance_roof, straight_roof}) {
    expect_roof(roof(method, {square(10, 10)}), 10 * 10 * 5 / 3.0, 5);
    expect_roof(roof(method, {square(7, 3)}), 3 * 3 * (3 * 7 - 3) / 12.0, 1.5);
    expect_roof(roof(method, {turned({0, 0, 1}, 20, {square(7, 3)})}), 3 * 3 * (3 * 7 - 3) / 12.0, 1.5);
  }
}

// All sides of a regular polygon rise to one point, at the radius of the inscribed circle.
TEST_F(Roofs, OfRegularPolygons) {
  for (const int edges : {3, 5, 8, 30, 100, 360}) {
    const double angle = std::numbers::pi / edges, inner = 10 * std::cos(angle);
    const double area = edges * 10 * std::sin(angle) * inner;
    expect_roof(roof(straight_roof, {circle(10, edges)}), area * inner / 3, inner, 1e-6);
  }
}

double distance_to(const Ring& ring, Vec2 p) {
  double least = INFINITY;
  for (size_t n = 0; n < ring.size(); ++n) {
    const Vec2 from = ring[n], along = ring[(n + 1) % ring.size()] - from;
    const double t = std::clamp(dot(p - from, along) / dot(along, along), 0.0, 1.0);
    least = std::min(least, length(p - from - t * along));
  }
  return least;
}

// Sums distances from the outline over the middles of small squares, of which whole numbers make up the region.
double summed_distance(const Region& region, double size, int steps) {
  const double step = size / steps;
  double sum = 0;
  for (int x = 0; x < steps; ++x)
    for (int y = 0; y < steps; ++y) {
      const Vec2 p{(x + 0.5) * step, (y + 0.5) * step};
      int windings = 0;
      double least = INFINITY;
      for (const Ring& ring : region.rings) {
        least = std::min(least, distance_to(ring, p));
        for (size_t n = 0; n < ring.size(); ++n) {
          const Vec2 a = ring[n], b = ring[(n + 1) % ring.size()];
          if (a.x == b.x && a.x > p.x && (a.y < p.y) != (b.y < p.y)) windings += a.y < b.y ? 1 : -1;
        }
      }
      if (windings != 0) sum += least * step * step;
    }
  return sum;
}

void expect_distances(const TreePtr& shape, double size) {
  const double expected = summed_distance(*evaluated(shape)[0].region(), size, 200);
  const Measures found = roof_measures(roof(distance_roof, {shape}, {360}));
  EXPECT_NEAR(found.volume, expected, 1e-3 * expected);
  EXPECT_EQ(found.messages, "");
}

// Shrunk by t, an L has the area (a - 2t)^2 - (a - w)^2 if its inner corner stays sharp.
TEST_F(Roofs, OfAnL) {
  const double a = 10, w = 4, notch = a - w;
  const TreePtr hook = node(Polygon{{{0, 0}, {a, 0}, {a, w}, {w, w}, {w, a}, {0, a}}, {}});
  expect_roof(roof(straight_roof, {hook}), (a * a * a - std::pow(notch, 3)) / 6 - notch * notch * w / 2, w / 2);
  // The highest point is as far from the inner corner as from the outer sides.
  EXPECT_NEAR(roof_measures(roof(distance_roof, {hook}, {360})).height, w * (2 - std::numbers::sqrt2), 1e-4);
  expect_distances(hook, a);
}

// Shrunk by t, a square with a square hole has the area (10 - 2t)^2 - (4 + 2t)^2, for t from 0 to 1.5.
TEST_F(Roofs, OfAFrame) {
  const TreePtr frame = difference({square(10, 10), moved(3, 3, 0, {square(4, 4)})});
  const double volume = (std::pow(10, 3) - std::pow(7, 3)) / 6 - (std::pow(7, 3) - std::pow(4, 3)) / 6;
  expect_roof(roof(straight_roof, {frame}), volume, 1.5);
  expect_distances(frame, 10);
}

// A round hole in a round disc, divided finely, is nearly a ring with a triangular section.
TEST_F(Roofs, OfARing) {
  const TreePtr ring = difference({circle(10, 200), circle(6, 200)});
  const double volume = 2 * std::numbers::pi * 8 * (4 * 2 / 2.0);
  for (const RoofMethod method : {distance_roof, straight_roof}) expect_roof(roof(method, {ring}), volume, 2, 2e-3);
}

TEST_F(Roofs, OfSeveralShapesAndIslands) {
  const double pyramid = 4 * 4 * 2 / 3.0;
  expect_roof(roof(straight_roof, {square(4, 4), moved(6, 0, 0, {square(4, 4)})}), 2 * pyramid, 2);
  const TreePtr island =
      group({difference({square(30, 30), moved(1, 1, 0, {square(28, 28)})}), moved(13, 13, 0, {square(4, 4)})});
  const double frame = (30.0 * 30 * 30 - 29.0 * 29 * 29) / 6 - (29.0 * 29 * 29 - 28.0 * 28 * 28) / 6;
  expect_roof(roof(straight_roof, {island}), frame + pyramid, 2);
}

TEST_F(Roofs, OfShapesThatTouchInAPoint) {
  const double pyramid = 4 * 4 * 2 / 3.0;
  expect_roof(roof(straight_roof, {square(4, 4), moved(4, 4, 0, {square(4, 4)})}), 2 * pyramid, 2, 1e-5);
}

TEST_F(Roofs, OfRandomStars) {
  uint32_t state = 1;
  const auto random = [&] { return (state = 1664525 * state + 1013904223) / 4294967296.0; };
  for (int star = 0; star < 20; ++star) {
    Polygon polygon;
    const int corners = 5 + static_cast<int>(40 * random());
    for (int n = 0; n < corners; ++n) {
      const double radius = 3 + 7 * random(), angle = 2 * std::numbers::pi * n / corners;
      polygon.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    const TreePtr shape = node(polygon);
    const Measures straight = roof_measures(roof(straight_roof, {shape}));
    const Measures rounded = roof_measures(roof(distance_roof, {shape}));
    EXPECT_EQ(straight.messages + rounded.messages, "");
    EXPECT_GE(rounded.volume, straight.volume * (1 - 1e-6));
    // Shrinking by a step of the height gives the same section as cutting the roof.
    const double level = straight.height / 3;
    const TreePtr cut = node(Projection{true}, {moved(0, 0, -level, {roof(straight_roof, {shape})})});
    const double expected = size_of(node(Offset{-level, false, false, {}}, {shape}));
    EXPECT_NEAR(size_of(cut), expected, 0.05 * expected + 1e-3);
  }
}

// Every corner of a roof is as high as it is far from the outline, also where waves of inward corners meet a far side.
TEST_F(Roofs, OfManyInwardCorners) {
  constexpr int waves = 20;
  Polygon wavy;
  for (int n = 0; n <= waves; ++n) wavy.points.push_back({static_cast<double>(n), n % 2 == 0 ? 0.0 : 0.3});
  for (int n = waves; n >= 0; --n) wavy.points.push_back({static_cast<double>(n), n % 3 == 0 ? 8.0 : 7.7});
  Diagnostics messages;
  const TreePtr shape = node(wavy);
  const Region region = *evaluated(shape)[0].region();
  const Pieces pieces = evaluate(roof(distance_roof, {shape}, {60}), {}, messages);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_TRUE(is_closed(pieces[0].solid()->mesh()));
  size_t tops = 0;
  for (const Vec3& p : pieces[0].solid()->mesh().points) {
    EXPECT_NEAR(p.z, distance_to(region.rings[0], {p.x, p.y}), 1e-2);
    tops += p.z > 3 ? 1U : 0U;
  }
  EXPECT_GT(tops, 5U);
}

}  // namespace
}  // namespace ombre::solids
