// Tests outlines of designs against mathematics and against voxels.
#include "jobs/outline/contour_job.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "jobs/slice/plan.h"
#include "jobs/test_designs.h"

namespace ombre::compile {
namespace {

using std::numbers::pi;
using surface::Polygon;
using Polygons = std::vector<Polygon>;

struct Drawn {
  ContourPlan plan;
  std::vector<LayerRegions> layers;
};

Drawn draw(const std::string& text, const ContourRequest& request = {}, int threads = 2) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(text, diagnostics);
  auto plan = loaded ? plan_contours(*loaded, request, diagnostics) : std::nullopt;
  EXPECT_FALSE(diagnostics.has_errors()) << to_text(diagnostics);
  if (!plan) return {};
  Drawn drawn{std::move(*plan), {}};
  draw_contours(drawn.plan, threads, [&](int64_t, const LayerRegions& regions) { drawn.layers.push_back(regions); });
  return drawn;
}

ContourRequest at(double z, double tolerance = 0.01) {
  ContourRequest request;
  request.z_mm = z;
  request.tolerance_mm = tolerance;
  return request;
}

// Returns the only layer of one region.
Polygons outline(const std::string& text, const ContourRequest& request) {
  const Drawn drawn = draw(text, request);
  return drawn.layers.size() == 1 && drawn.layers[0].size() == 1 ? drawn.layers[0][0] : Polygons{};
}

double side(Vec2 a, Vec2 b, Vec2 p) { return cross(b - a, p - a); }

using Edge = std::pair<Vec2, Vec2>;

bool do_cross(const Edge& s, const Edge& o) {
  return side(s.first, s.second, o.first) * side(s.first, s.second, o.second) < 0 &&
         side(o.first, o.second, s.first) * side(o.first, o.second, s.second) < 0;
}

std::vector<Edge> edges_of(const LayerRegions& layer) {
  std::vector<Edge> edges;
  for (const Polygons& polygons : layer)
    for (const Polygon& p : polygons)
      for (size_t n = 0; n < p.size(); ++n) edges.emplace_back(p[n], p[(n + 1) % p.size()]);
  return edges;
}

// Polygons are closed, go around something, and do not cross.
void expect_sound(const LayerRegions& layer) {
  for (const Polygons& polygons : layer)
    for (const Polygon& polygon : polygons) {
      EXPECT_GE(polygon.size(), 3U);
      EXPECT_NE(surface::area_mm2(polygon), 0);
    }
  const std::vector<Edge> edges = edges_of(layer);
  size_t crossing = 0;
  for (size_t n = 0; n < edges.size(); ++n) {
    EXPECT_FALSE(edges[n].first == edges[n].second);
    for (size_t m = 0; m < n; ++m) crossing += do_cross(edges[n], edges[m]);
  }
  EXPECT_EQ(crossing, 0U);
}

std::array<double, 4> key(const Edge& e) { return {e.first.x, e.first.y, e.second.x, e.second.y}; }

// Counts edges that have no region on their other side, and edges that have one.
struct Borders {
  std::vector<Edge> outer;
  size_t shared = 0;
};

Borders borders_of(const LayerRegions& layer) {
  const std::vector<Edge> edges = edges_of(layer);
  std::set<std::array<double, 4>> all;
  for (const Edge& e : edges) EXPECT_TRUE(all.insert(key(e)).second) << "an edge is there twice";
  Borders borders;
  for (const Edge& e : edges)
    if (all.contains(key({e.second, e.first})))
      ++borders.shared;
    else
      borders.outer.push_back(e);
  return borders;
}

double area_within(const std::vector<Edge>& edges) {
  double twice = 0;
  for (const Edge& e : edges) twice += cross(e.first, e.second);
  return 0.5 * twice;
}

double area_of(const LayerRegions& layer) {
  double area = 0;
  for (const Polygons& polygons : layer) area += surface::area_mm2(polygons);
  return area;
}

std::string number(double value) { return std::to_string(value); }

}  // namespace

TEST(ContourJob, CircleLiesWithinTolerance) {
  for (const double tolerance : {0.1, 0.02, 0.003}) {
    const Polygons made = outline("cylinder(10, 4);", at(0.3, tolerance));
    ASSERT_EQ(made.size(), 1U);
    for (const Vec2 p : made[0]) EXPECT_NEAR(std::hypot(p.x, p.y), 10, tolerance);
    for (size_t n = 0; n < made[0].size(); ++n) {
      const Vec2 a = made[0][n], b = made[0][(n + 1) % made[0].size()];
      EXPECT_NEAR(std::hypot(a.x + b.x, a.y + b.y) / 2, 10, tolerance);
    }
    EXPECT_NEAR(surface::area_mm2(made), 100 * pi, 20 * pi * tolerance);
    expect_sound({made});
  }
}

TEST(ContourJob, TiltedSquareKeepsItsCorners) {
  for (int degrees = 1; degrees < 90; degrees += 4) {
    const Polygons made = outline("translate(0.3, 0.1, 0) rotate(0, 0, " + number(degrees) + ") cube(10);", at(0.1));
    ASSERT_EQ(made.size(), 1U) << degrees;
    ASSERT_EQ(made[0].size(), 4U) << degrees;
    for (int corner = 0; corner < 4; ++corner) {
      const double angle = (degrees + 45 + 90 * corner) * pi / 180, r = 5 * std::sqrt(2.0);
      const Vec2 wanted{0.3 + r * std::cos(angle), 0.1 + r * std::sin(angle)};
      const auto near = [&](Vec2 p) { return std::hypot(p.x - wanted.x, p.y - wanted.y) < 1e-6; };
      EXPECT_TRUE(std::ranges::any_of(made[0], near)) << degrees << " degrees, corner " << corner;
    }
  }
}

TEST(ContourJob, RingHasAHole) {
  const Polygons made = outline("difference() { cylinder(10, 4); cylinder(5, 6); }", at(0));
  ASSERT_EQ(made.size(), 2U);
  EXPECT_NEAR(surface::area_mm2(made[0]), 100 * pi, 20 * pi * 0.01);
  EXPECT_NEAR(surface::area_mm2(made[1]), -25 * pi, 10 * pi * 0.01);
  for (const Vec2 p : made[1]) EXPECT_NEAR(std::hypot(p.x, p.y), 5, 0.01);
}

TEST(ContourJob, HalvesShareTheirBorder) {
  ContourRequest request = at(0.2, 0.02);
  request.by_material = true;
  const Drawn drawn =
      draw(R"(fgrade(["0.5 + (x + 2*sin(y))/40", "0.5 - (x + 2*sin(y))/40"], ["red", "blue"]) rectprism(20, 14, 4);)",
           request);
  ASSERT_EQ(drawn.layers.size(), 1U);
  ASSERT_EQ(drawn.layers[0].size(), 2U);
  const Borders borders = borders_of(drawn.layers[0]);
  EXPECT_GT(borders.shared, 20U);
  EXPECT_NEAR(area_within(borders.outer), 280, 1e-6);
  EXPECT_NEAR(area_of(drawn.layers[0]), 280, 1e-6);
  // The sine sums to nothing over a symmetric range.
  EXPECT_NEAR(surface::area_mm2(drawn.layers[0][0]), 140, 0.02 * 20);
  expect_sound(drawn.layers[0]);
}

TEST(ContourJob, ThreeRegionsMeetInAPoint) {
  for (int n = 0; n < 12; ++n) {
    const double x = 0.37 * n, y = 0.23 * n;
    const std::string u = "(x-" + number(x) + ")", v = "(y-" + number(y) + ")";
    ContourRequest request = at(0, 0.05);
    request.by_material = true;
    const Drawn drawn =
        draw("fgrade([\"1/3 + " + u + "/60\", \"1/3 - " + u + "/120 + 0.0144337567*" + v + "\", \"1/3 - " + u +
                 "/120 - 0.0144337567*" + v + "\"], [\"red\", \"green\", \"blue\"]) cylinder(10, 2);",
             request);
    ASSERT_EQ(drawn.layers.size(), 1U);
    ASSERT_EQ(drawn.layers[0].size(), 3U);
    std::map<std::pair<double, double>, int> regions_at;
    for (const Polygons& polygons : drawn.layers[0])
      for (const Polygon& p : polygons)
        for (const Vec2 q : p) ++regions_at[{q.x, q.y}];
    int meeting = 0;
    for (const auto& [p, count] : regions_at) {
      if (count != 3) continue;
      ++meeting;
      EXPECT_NEAR(p.first, x, 1e-6) << n;
      EXPECT_NEAR(p.second, y, 1e-6) << n;
    }
    EXPECT_EQ(meeting, 1);
    EXPECT_NEAR(area_of(drawn.layers[0]), area_within(borders_of(drawn.layers[0]).outer), 1e-9);
    expect_sound(drawn.layers[0]);
  }
}

TEST(ContourJob, GyroidHasTheAreaOfItsVoxels) {
  const std::string text =
      "intersection() { cube(8); function(\"sin(pi/2*x)*cos(pi/2*y) + sin(pi/2*y)*cos(pi/2*z) + "
      "sin(pi/2*z)*cos(pi/2*x)\"); }";
  ContourRequest request;
  request.layer_height = Pitch{1, 2};
  const Drawn drawn = draw(text, request);
  PlanOptions options;
  options.pitch = {Pitch{1, 50}, Pitch{1, 50}, Pitch{1, 2}};
  const Voxels voxels = slice_text(text, options);
  ASSERT_EQ(static_cast<int64_t>(drawn.layers.size()), voxels.lattice.count[2]);
  for (size_t k = 0; k < drawn.layers.size(); ++k) {
    const auto per_layer = static_cast<std::ptrdiff_t>(voxels.lattice.count[0] * voxels.lattice.count[1]);
    const auto begin = voxels.ids.begin() + static_cast<std::ptrdiff_t>(k) * per_layer;
    const auto count = std::count_if(begin, begin + per_layer, [](MaterialId id) { return id != 0; });
    EXPECT_NEAR(area_of(drawn.layers[k]), static_cast<double>(count) * 0.02 * 0.02, 0.1) << k;
    expect_sound(drawn.layers[k]);
  }
}

TEST(ContourJob, ThinFeaturesStaySound) {
  // Cells are 0.8 mm: a plate of two cells is kept, and one of a tenth of a cell is lost here and there.
  const Polygons thick = outline("rotate(0, 0, 17) rectprism(20, 1.6, 4);", at(0, 0.1));
  ASSERT_EQ(thick.size(), 1U);
  EXPECT_NEAR(surface::area_mm2(thick), 32, 0.1);
  for (const double width : {0.9, 0.5, 0.2, 0.08}) {
    const Polygons thin = outline("rotate(0, 0, 17) rectprism(20, " + number(width) + ", 4);", at(0, 0.1));
    expect_sound({thin});
    EXPECT_LT(surface::area_mm2(thin), 20 * width + 1);
  }
  expect_sound({outline("union() { translate(-2, -2, 0) cube(4); translate(2.01, 2.01, 0) cube(4); }", at(0, 0.05))});
}

TEST(ContourJob, EmptyLayersHaveNoPolygons) {
  ContourRequest request;
  request.layer_height = Pitch{1, 1};
  const Drawn drawn = draw("union() { translate(0, 0, -6) sphere(2); translate(0, 0, 6) sphere(2); }", request);
  ASSERT_EQ(drawn.layers.size(), 16U);
  for (size_t k = 0; k < 16; ++k) EXPECT_EQ(drawn.layers[k][0].size(), k < 4 || k >= 12 ? 1U : 0U) << k;
}

TEST(ContourJob, ThreadsChangeNothing) {
  const std::string text = R"(fgrade(["0.5 + z/10", "0.5 - z/10"], ["red", "blue"]) sphere(5);)";
  ContourRequest request;
  request.bands = BandRequest{3, {}, ""};
  EXPECT_EQ(draw(text, request, 1).layers, draw(text, request, 2).layers);
}

TEST(ContourJob, HeightsBesideThePartAreReported) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text("sphere(5);", diagnostics);
  EXPECT_FALSE(plan_contours(*loaded, at(5.1), diagnostics));
  EXPECT_NE(to_text(diagnostics).find("z 5.1 mm is beside the part, which lies from z -5 to 5 mm"), std::string::npos);
}

}  // namespace ombre::compile
