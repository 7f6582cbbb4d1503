#include "import/fields/result_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "import/fields/result_source.h"

namespace ombre::importing {
namespace {

using formats::Results;

constexpr std::array<ElementKind, formats::element_kinds> all_kinds{
    ElementKind::tetrahedron4, ElementKind::tetrahedron10, ElementKind::brick8,
    ElementKind::brick20,      ElementKind::wedge6,        ElementKind::pyramid5};

// The elements that fill a cube, by the numbers of its corners; 8 is its middle.
std::vector<std::vector<size_t>> elements_of_cube(ElementKind kind) {
  if (is_tetrahedron(kind)) return {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  // The second wedge begins with its upper triangle, as VTK's do.
  if (kind == ElementKind::wedge6) return {{0, 1, 2, 4, 5, 6}, {4, 6, 7, 0, 2, 3}};
  if (kind == ElementKind::pyramid5)
    return {{0, 1, 2, 3, 8}, {4, 7, 6, 5, 8}, {0, 4, 5, 1, 8}, {1, 5, 6, 2, 8}, {2, 6, 7, 3, 8}, {3, 7, 4, 0, 8}};
  return {{0, 1, 2, 3, 4, 5, 6, 7}};
}

// Makes a grid of 3 x 3 x 3 cubes of 2 mm, each filled by elements of one kind. Inner corners are moved by up to
// `shift` mm.
class GridMaker {
 public:
  GridMaker(ElementKind kind, double shift) : kind_(kind), random_(5), shift_(shift) {}

  Results run() {
    for (int k = 0; k <= 3; ++k)
      for (int j = 0; j <= 3; ++j)
        for (int i = 0; i <= 3; ++i) corners_.push_back(add(corner(i, j, k)));
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) add_cube(i, j, k);
    return std::move(results_);
  }

 private:
  Vec3 corner(int i, int j, int k) {
    const auto moved = [&](int n) {
      const double off = std::uniform_real_distribution<double>(-shift_, shift_)(random_);
      return 2.0 * n + (n == 0 || n == 3 ? 0 : off);
    };
    const double x = moved(i), y = moved(j), z = moved(k);
    return {x, y, z};
  }
  uint32_t add(Vec3 p) {
    results_.points.push_back(p);
    return static_cast<uint32_t>(results_.points.size() - 1);
  }
  uint32_t between(uint32_t a, uint32_t b) {
    const auto [known, is_new] = middles_.try_emplace(std::minmax(a, b), 0U);
    if (is_new) known->second = add(0.5 * (results_.points[a] + results_.points[b]));
    return known->second;
  }
  void add_cube(int i, int j, int k) {
    std::array<uint32_t, 9> cube{};
    Vec3 middle;
    for (size_t n = 0; n < 8; ++n) {
      const Vec3 place = node_places(ElementKind::brick8)[n];
      const int x = i + (place.x > 0), y = j + (place.y > 0), z = k + (place.z > 0);
      cube[n] = corners_[static_cast<size_t>((z * 4 + y) * 4 + x)];
      middle = middle + 0.125 * results_.points[cube[n]];
    }
    if (kind_ == ElementKind::pyramid5) cube[8] = add(middle);
    for (const std::vector<size_t>& own : elements_of_cube(kind_)) {
      std::vector<uint32_t> nodes;
      for (const size_t n : own) nodes.push_back(cube[n]);
      add_element(nodes);
    }
  }
  // Nodes between corners lie in the middle of their edges.
  void add_element(std::vector<uint32_t> nodes) {
    const size_t corners = nodes.size();
    const auto places = node_places(kind_);
    for (size_t n = corners; n < node_count(kind_); ++n)
      for (size_t a = 0; a < corners; ++a)
        for (size_t b = 0; b < a; ++b)
          if (length(0.5 * (places[a] + places[b]) - places[n]) < 1e-9) nodes.push_back(between(nodes[a], nodes[b]));
    ASSERT_EQ(nodes.size(), node_count(kind_));
    results_.add_element(kind_, nodes.data());
  }

  ElementKind kind_;
  std::mt19937 random_;
  double shift_;
  Results results_;
  std::vector<uint32_t> corners_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles_;
};

double linear(Vec3 p) { return 3 - 2 * p.x + 0.5 * p.y + 7 * p.z; }
double quadratic(Vec3 p) { return 1 + p.x * p.y - 2 * p.z * p.z + 0.3 * p.x * p.x + linear(p); }

template <class F>
std::shared_ptr<const ResultMesh> mesh_with(ElementKind kind, double shift, const F& f) {
  Results results = GridMaker(kind, shift).run();
  formats::ResultField field{"f", "", 1, false, {}}, numbers{"number", "", 1, true, {}};
  for (const Vec3& p : results.points) field.values.push_back(f(p));
  for (size_t n = 0; n < results.kinds.size(); ++n) numbers.values.push_back(static_cast<double>(n));
  results.fields = {field, numbers};
  return std::make_shared<ResultMesh>(std::move(results));
}

Vec3 random_point(std::mt19937& random, double from, double to) {
  std::uniform_real_distribution<double> along(from, to);
  const double x = along(random), y = along(random), z = along(random);
  return {x, y, z};
}

program::SourceField source_of(const std::shared_ptr<const ResultMesh>& mesh, const OutsideRule& rule) {
  return make_result_source("mesh", mesh, rule, {});
}

constexpr OutsideRule nowhere{}, anywhere{OutsideRule::Kind::nearest}, seven{OutsideRule::Kind::value, Box::inf, 7};

}  // namespace

TEST(ResultMesh, LinearFieldsAreExactInDistortedElements) {
  for (const ElementKind kind : all_kinds) {
    const auto mesh = mesh_with(kind, 0.5, linear);
    const auto source = source_of(mesh, nowhere);
    std::mt19937 random(1);
    for (int n = 0; n < 2000; ++n) {
      const Vec3 p = random_point(random, 0, 6);
      ASSERT_NEAR(source->sample(1, p), linear(p), 1e-10) << static_cast<int>(kind);
      ASSERT_EQ(source->sample(0, p), 1);
    }
  }
}

TEST(ResultMesh, QuadraticFieldsAreExactInQuadraticElements) {
  for (const ElementKind kind : {ElementKind::tetrahedron10, ElementKind::brick20}) {
    const auto mesh = mesh_with(kind, kind == ElementKind::tetrahedron10 ? 0.5 : 0, quadratic);
    const auto source = source_of(mesh, nowhere);
    std::mt19937 random(2);
    for (int n = 0; n < 2000; ++n) {
      const Vec3 p = random_point(random, 0, 6);
      ASSERT_NEAR(source->sample(1, p), quadratic(p), 1e-9);
    }
  }
}

TEST(ResultMesh, NodesHaveTheirValues) {
  for (const ElementKind kind : all_kinds) {
    const auto mesh = mesh_with(kind, 0.5, [](Vec3 p) { return std::sin(9 * p.x + p.y * p.z); });
    const auto source = source_of(mesh, nowhere);
    const auto& results = mesh->results();
    for (size_t n = 0; n < results.points.size(); ++n)
      ASSERT_NEAR(source->sample(1, results.points[n]), results.fields[0].values[n], 1e-6) << static_cast<int>(kind);
  }
}

// Shape functions sum to 1, each is 1 at its own node and 0 at the others, and slopes agree with finite differences.
TEST(ElementShapes, AreShapeFunctions) {
  std::mt19937 random(3);
  for (const ElementKind kind : all_kinds) {
    const size_t count = node_count(kind);
    std::vector<double> weights(count), after(count);
    std::vector<Vec3> slopes(count);
    for (size_t node = 0; node < count; ++node) {
      shape_weights(kind, node_places(kind)[node], weights);
      for (size_t n = 0; n < count; ++n) ASSERT_NEAR(weights[n], n == node ? 1 : 0, 1e-14);
    }
    const Vec3 at = 0.25 * random_point(random, 0, 1);
    shape_weights(kind, at, weights);
    shape_slopes(kind, at, slopes);
    double sum = 0;
    for (size_t n = 0; n < count; ++n) sum += weights[n];
    EXPECT_NEAR(sum, 1, 1e-14);
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double step = 1e-6;
      Vec3 next = at;
      next[axis] += step;
      shape_weights(kind, next, after);
      for (size_t n = 0; n < count; ++n) ASSERT_NEAR((after[n] - weights[n]) / step, slopes[n][axis], 1e-5);
    }
  }
}

TEST(ElementShapes, AffineElementsAreFoundAtOnce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vec = [&] { return Vec3{any(random), any(random), any(random)}; };
  for (const ElementKind kind : all_kinds)
    for (int round = 0; round < 20 && kind != ElementKind::pyramid5; ++round) {
      const Vec3 origin = 10 * vec(), u = vec() + Vec3{3, 0, 0}, v = vec() + Vec3{0, 3, 0}, w = vec() + Vec3{0, 0, 3};
      const auto map = [&](Vec3 at) { return origin + at.x * u + at.y * v + at.z * w; };
      std::vector<Vec3> nodes;
      for (const Vec3& place : node_places(kind)) nodes.push_back(map(place));
      ASSERT_TRUE(is_affine(kind, nodes));
      const Vec3 wanted = vec();
      Vec3 quick, slow;
      ASSERT_TRUE(place_in_affine_element(kind, nodes, map(wanted), quick));
      ASSERT_TRUE(place_in_element(kind, nodes, map(wanted), slow));
      EXPECT_LT(length(quick - wanted), 1e-12);
      EXPECT_LT(length(slow - wanted), 1e-12);
      nodes.back().x += 1e-9;
      EXPECT_EQ(is_affine(kind, nodes), kind == ElementKind::tetrahedron4);
    }
}

TEST(ElementShapes, BoundsHoldAllValues) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const ElementKind kind : all_kinds)
    for (int n = 0; n < 20; ++n) {
      std::vector<double> values(node_count(kind)), weights(values.size());
      for (double& value : values) value = any(random);
      const Interval bounds = field_bounds(kind, values);
      for (int m = 0; m < 200; ++m) {
        const Vec3 at =
            clamped_to(kind, is_tetrahedron(kind) ? random_point(random, 0, 0.6) : random_point(random, -1, 1));
        ASSERT_TRUE(is_in_element(kind, at, 1e-12));
        shape_weights(kind, at, weights);
        double value = 0;
        for (size_t c = 0; c < values.size(); ++c) value += weights[c] * values[c];
        ASSERT_LE(bounds.lo - 1e-12, value);
        ASSERT_GE(bounds.hi + 1e-12, value);
      }
    }
}

// Opposite to a cube's side, the nearest point is straight behind it.
TEST(ResultMesh, OutsideCountsAsTheRuleSays) {
  for (const ElementKind kind : all_kinds) {
    const auto mesh = mesh_with(kind, 0, linear);
    const auto near_to = source_of(mesh, anywhere);
    const auto close = source_of(mesh, {OutsideRule::Kind::nearest, 0.75, 0});
    std::mt19937 random(6);
    for (int n = 0; n < 500; ++n) {
      const Vec3 p = random_point(random, -3, 9);
      const Vec3 kept{std::clamp(p.x, 0.0, 6.0), std::clamp(p.y, 0.0, 6.0), std::clamp(p.z, 0.0, 6.0)};
      ASSERT_NEAR(near_to->sample(1, p), linear(kept), 1e-9);
      const bool is_in = p == kept;
      ASSERT_EQ(near_to->sample(0, p), is_in ? 1 : 0);
      ASSERT_EQ(std::isnan(source_of(mesh, nowhere)->sample(1, p)), !is_in);
      ASSERT_EQ(std::isnan(close->sample(1, p)), length(p - kept) > 0.75);
      ASSERT_NEAR(source_of(mesh, seven)->sample(1, p), is_in ? linear(p) : 7, 1e-9);
    }
  }
}

TEST(ResultMesh, TheNearestPlaceDoesNotDependOnWhereTheLastOneWas) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-4, 10);
  for (const ElementKind kind : all_kinds) {
    const ResultMesh mesh(GridMaker(kind, 0.4).run());
    uint32_t triangle = UINT32_MAX;
    for (int n = 0; n < 2000; ++n) {
      Vec3 p{any(random), any(random), any(random)};
      // Many points are equally near to several triangles: at edges and corners, and in the middle of the cube.
      if (n % 2 == 0) p = {std::round(p.x), std::round(p.y), std::round(p.z)};
      const ElementPlace with = mesh.nearest(p, &triangle), without = mesh.nearest(p);
      ASSERT_EQ(with.element, without.element) << n;
      ASSERT_EQ(with.at, without.at);
      ASSERT_EQ(with.distance_mm, without.distance_mm);
    }
  }
}

TEST(ResultMesh, RangesHoldAllValues) {
  for (const ElementKind kind : all_kinds) {
    const auto mesh = mesh_with(kind, 0.4, [](Vec3 p) { return std::sin(3 * p.x) * p.y + p.z; });
    for (const OutsideRule& rule : {nowhere, anywhere, seven, OutsideRule{OutsideRule::Kind::nearest, 0.5, 0}}) {
      const auto source = source_of(mesh, rule);
      std::mt19937 random(7);
      for (int n = 0; n < 40; ++n) {
        const Vec3 a = random_point(random, -2, 8), b = a + random_point(random, 0, n % 2 == 0 ? 1 : 4);
        for (const int channel : {0, 1, 2}) {
          const Interval range = source->range(channel, {a, b});
          for (int m = 0; m < 50; ++m) {
            const Vec3 share = random_point(random, 0, 1);
            const Vec3 p{a.x + share.x * (b.x - a.x), a.y + share.y * (b.y - a.y), a.z + share.z * (b.z - a.z)};
            ASSERT_TRUE(range.contains(source->sample(channel, p)));
          }
        }
      }
    }
  }
}

// Values of elements are constant inside. On common sides the first element's value counts, whatever was queried
// before.
TEST(ResultMesh, ElementsKeepTheirValues) {
  const auto mesh = mesh_with(ElementKind::brick8, 0, linear);
  const auto source = source_of(mesh, nowhere);
  EXPECT_EQ(source->sample(2, {1, 1, 1}), 0);
  EXPECT_EQ(source->sample(2, {5.9, 0.1, 1}), 2);
  EXPECT_EQ(source->sample(2, {2, 1, 1}), 0);
  EXPECT_EQ(source->sample(2, {4, 4, 4}), 13);
  const std::vector<Vec3> points{{2.5, 1, 1}, {2, 1, 1}, {1.9, 1, 1}, {2, 2, 2}, {3, 3, 3}, {2, 2, 2}, {-1, 0, 0}};
  std::vector<double> numbers(points.size()), values(points.size());
  const std::array<double*, 2> rows{numbers.data(), values.data()};
  const std::array<int, 2> channels{2, 1};
  source->sample_channels(channels, points, rows);
  for (size_t n = 0; n + 1 < points.size(); ++n) {
    EXPECT_EQ(numbers[n], source->sample(2, points[n]));
    EXPECT_EQ(values[n], source->sample(1, points[n]));
  }
  EXPECT_TRUE(std::isnan(values.back()));
}

// The border is that of a cube of 6 mm, whatever fills it, and its triangles face outwards.
TEST(ResultMesh, TheBorderEnclosesTheMesh) {
  for (const ElementKind kind : all_kinds) {
    const auto mesh = mesh_with(kind, 0, linear);
    double volume = 0, area = 0;
    for (const BorderTriangle& t : mesh->border()) {
      const auto& points = mesh->results().points;
      const Vec3 a = points[t.points[0]], b = points[t.points[1]], c = points[t.points[2]];
      volume += dot(a, cross(b, c)) / 6;
      area += 0.5 * length(cross(b - a, c - a));
    }
    EXPECT_NEAR(volume, 216, 1e-9);
    EXPECT_NEAR(area, 216, 1e-9);
  }
}

// An element has a curved side, because a node between corners is moved outwards; points behind that side are found.
TEST(ResultMesh, CurvedElementsHoldTheirPoints) {
  Results results;
  for (const Vec3& p : node_places(ElementKind::tetrahedron10)) results.points.push_back(p);
  results.points[5] = {0.6, 0.6, 0};
  std::vector<uint32_t> nodes(10);
  for (uint32_t n = 0; n < 10; ++n) nodes[n] = n;
  results.add_element(ElementKind::tetrahedron10, nodes.data());
  const ResultMesh mesh(std::move(results));
  EXPECT_TRUE(mesh.place({0.59, 0.59, 0.001}));
  EXPECT_FALSE(mesh.place({0.61, 0.61, 0.001}));
}

}  // namespace ombre::importing
