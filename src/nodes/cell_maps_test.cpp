// Compares maps of cells, and the solids on them, with formulas of their geometry and with rays.
#include "nodes/test_values.h"

namespace ombre::nodes {
namespace {

using namespace test;

class CellMaps : public ValueTest {
 protected:
  // Returns a pipe of 12 cells around, 4 along and 2 outward.
  NodePtr pipe() { return cylinder(8, 10, 20, {12, 4, 2}); }
  NodePtr cylinder(double inner, double outer, double height, Vec3 count) {
    return make("cylinder_cells", {{"inner", Data(inner)},
                                   {"outer", Data(outer)},
                                   {"height", Data(height)},
                                   {"count", list({count.x, count.y, count.z})}});
  }
  NodePtr box(Vec3 size) { return make("box_cells", {{"size", list({size.x, size.y, size.z})}}); }

  static Vec3 around_z(double rho, double degrees, double z) {
    return {rho * std::cos(degrees * pi / 180), rho * std::sin(degrees * pi / 180), z};
  }

  bool inside(const NodePtr& solid, Vec3 p) {
    return values(solid, p, [&](Lowering& lowering, const Point& at) {
             return std::vector{lowering.inside(*solid, at)};
           })[0] == 1;
  }
  // Returns the length from p to where the solid ends in a direction.
  double way_out(const NodePtr& solid, Vec3 p, Vec3 direction, double most) {
    double in = 0, out = most;
    for (int n = 0; n < 40; ++n) (inside(solid, p + 0.5 * (in + out) * direction) ? in : out) = 0.5 * (in + out);
    return in;
  }
  Vec3 normal(const NodePtr& solid, Vec3 p) {
    constexpr double h = 1e-5;
    const auto rise = [&](Vec3 by) { return distance(solid, p + by) - distance(solid, p - by); };
    const Vec3 n{rise({h, 0, 0}), rise({0, h, 0}), rise({0, 0, h})};
    return (1 / length(n)) * n;
  }
};

}  // namespace

TEST_F(CellMaps, PlacesInAPipeAreAnglesHeightsAndRadii) {
  const NodePtr map = pipe();
  const Vec3 p = around_z(9.25, 50, -3);
  expect_near(vector_at(map, "place", p), {50.0 / 30, 7.0 / 5, 1.25}, 1e-12);
  expect_near(vector_at(map, "index", p), {1, 1, 1}, 1e-12);
  expect_near(vector_at(map, "local", p), {2.0 / 3, 0.4, 0.25}, 1e-12);
  const double arc = 9.25 * 30 * pi / 180;
  expect_near(vector_at(map, "size", p), {arc, 5, 1}, 1e-12);
  expect_near(vector_at(map, "stretches", p), {1, arc, 5}, 1e-12);
  EXPECT_NEAR(number_at(map, "volume", p), arc * 5, 1e-11);
  EXPECT_NEAR(number_at(map, "distance", p), 0.25, 1e-12);
  expect_near(vector_at(map, "slope_u", p), (1 / arc) * around_z(1, 140, 0), 1e-12);
  expect_near(vector_at(map, "slope_v", p), {0, 0, 0.2}, 1e-12);
  expect_near(vector_at(map, "slope_w", p), around_z(1, 50, 0), 1e-12);
}

TEST_F(CellMaps, TheRegionOfASectorIsTheSector) {
  const NodePtr map = make("cylinder_cells", {{"inner", Data(8.0)},
                                              {"outer", Data(10.0)},
                                              {"height", Data(20.0)},
                                              {"start", Data(30.0)},
                                              {"sweep", Data(200.0)},
                                              {"origin", list({1, 2, 3})},
                                              {"count", list({10, 1, 1})}});
  const auto number = map->type().output("region");
  ASSERT_TRUE(number);
  const Box bounds = map->output_bounds(*number, design_space());
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p = random_point(14), q = p - Vec3{1, 2, 3};
    const double rho = std::hypot(q.x, q.y), angle = std::atan2(q.y, q.x) * 180 / pi;
    const double turned = std::fmod(angle - 30 + 720, 360);
    const bool is_in = rho >= 8 && rho <= 10 && std::abs(q.z) <= 10 && turned <= 200;
    EXPECT_EQ(of_output(map, "region", p)[0] <= 0, is_in);
    if (!is_in) continue;
    EXPECT_TRUE(bounds.contains(p));
    EXPECT_NEAR(vector_at(map, "place", p).x, turned / 20, 1e-9);
  }
  EXPECT_LT(bounds.hi.z - bounds.lo.z, 20 + 1e-6);
}

TEST_F(CellMaps, SizesFitTheRegion) {
  const NodePtr map =
      make("box_cells", {{"size", list({6, 9, 30})}, {"min", list({0, 0, 0})}, {"max", list({20, 20, 10})}});
  expect_near(vector_at(map, "size", {1, 1, 1}), {20.0 / 3, 10, 10}, 1e-12);
  expect_near(vector_at(map, "place", {10, 5, 5}), {1.5, 0.5, 0.5}, 1e-12);
  expect_near(vector_at(map, "index", {20, 20, 10}), {2, 1, 0}, 0);
  const NodePtr endless = box({4, 5, 6});
  expect_near(vector_at(endless, "place", {-6, 7.5, 3}), {-1.5, 1.5, 0.5}, 1e-12);
  expect_near(vector_at(endless, "index", {-6, 7.5, 3}), {-2, 1, 0}, 0);
  EXPECT_FALSE(endless->gives(*endless->type().output("region")));
}

TEST_F(CellMaps, PlacesInABallAreAnglesAndRadii) {
  const NodePtr map = make("ball_cells", {{"inner", Data(8.0)},
                                          {"outer", Data(12.0)},
                                          {"south", Data(-30.0)},
                                          {"north", Data(60.0)},
                                          {"count", list({8, 3, 2})}});
  const double r = 11, latitude = 20 * pi / 180;
  const Vec3 p = around_z(r * std::cos(latitude), 100, r * std::sin(latitude));
  expect_near(vector_at(map, "place", p), {100.0 / 45, 50.0 / 30, 1.5}, 1e-12);
  expect_near(vector_at(map, "size", p), {r * std::cos(latitude) * pi / 4, r * pi / 6, 2}, 1e-12);
  EXPECT_LE(of_output(map, "region", p)[0], 0);
  EXPECT_GT(of_output(map, "region", {0, 0, 11})[0], 0) << "a pole";
}

// The volume is the determinant; the squares of stretches add up to those of the edges.
TEST_F(CellMaps, StretchesOfAConeAreThoseOfItsEdges) {
  DataMembers cone{{"count", list({9, 4, 3})}};
  for (const auto& [name, mm] : {std::pair("inner", 8.0), std::pair("outer", 12.0), std::pair("inner_top", 4.0),
                                 std::pair("outer_top", 5.0), std::pair("height", 10.0)})
    cone.emplace_back(name, mm);
  const NodePtr map = make("frustum_cells", cone);
  const double z = 1, inner = 6 - 0.4 * z, thickness = 2.5 - 0.3 * z, share = 0.6, rho = inner + share * thickness;
  const Vec3 p = around_z(rho, 77, z);
  expect_near(vector_at(map, "place", p), {77.0 / 40, 2.4, 1.8}, 1e-12);
  const Vec3 edges{rho * 2 * pi / 9, 2.5 * std::hypot(1, -0.4 - 0.3 * share), thickness / 3};
  expect_near(vector_at(map, "size", p), edges, 1e-11);
  const double volume = rho * 2 * pi / 9 * 2.5 * thickness / 3;
  EXPECT_NEAR(number_at(map, "volume", p), volume, 1e-11);
  const Vec3 stretches = vector_at(map, "stretches", p);
  EXPECT_NEAR(stretches.x * stretches.y * stretches.z, volume, 1e-6);
  EXPECT_NEAR(dot(stretches, stretches), dot(edges, edges), 1e-6);
  EXPECT_LE(stretches.x, stretches.y);
  EXPECT_LE(stretches.y, stretches.z);
}

TEST_F(CellMaps, PlacesAlongALineAreCoordinates) {
  const NodePtr map = make("curve_cells", {{"points", rows({{1, 2, 3}, {1, 22, 3}})},
                                           {"width", Data(4.0)},
                                           {"depth", Data(6.0)},
                                           {"count", list({10, 2, 3})}});
  // The curve runs along y and w is up, so v is along -x.
  expect_near(vector_at(map, "place", {1.5, 7, 2}), {2.5, 0.75, 1}, 1e-9);
  expect_near(vector_at(map, "place", {1.5, 0, 2}), {-1, 0.75, 1}, 1e-9);
  expect_near(vector_at(map, "size", {1.5, 7, 2}), {2, 2, 2}, 1e-9);
}

// Frames that do not turn around a curve make cells whose edges are perpendicular; across, they keep their size.
TEST_F(CellMaps, CellsAlongACurveArePerpendicular) {
  const NodePtr map =
      make("curve_cells", {{"points", rows({{0, 0, 0}, {12, 2, 0}, {18, 12, 6}, {12, 22, 12}, {0, 20, 20}})},
                           {"width", Data(4.0)},
                           {"depth", Data(6.0)},
                           {"count", list({20, 2, 2})}});
  int tried = 0;
  while (tried < 30) {
    const Vec3 p = random_point(22);
    if (of_output(map, "region", p)[0] > 0) continue;
    ++tried;
    const Vec3 u = vector_at(map, "slope_u", p), v = vector_at(map, "slope_v", p), w = vector_at(map, "slope_w", p);
    const Vec3 size = vector_at(map, "size", p);
    EXPECT_NEAR(length(u) * size.x, 1, 1e-4);
    EXPECT_NEAR(length(v) * 2, 1, 1e-4);
    EXPECT_NEAR(length(w) * 3, 1, 1e-4);
    for (const double product : {dot(u, v) * size.x * 2, dot(v, w) * 6, dot(w, u) * size.x * 3})
      EXPECT_NEAR(product, 0, 1e-4);
    EXPECT_GT(dot(u, cross(v, w)), 0);
  }
}

// The height of a closed curve at an angle around z; its frames turn around it.
double wave(double angle) { return 6 * std::cos(2 * angle) + 3 * std::sin(3 * angle + 1); }

// Returns points of that curve with a radius of 20, or of a circle.
Data ring(bool is_flat) {
  DataList points;
  for (int n = 0; n < 96; ++n) {
    const double angle = 2 * pi * n / 96;
    points.emplace_back(DataList{20 * std::cos(angle), 20 * std::sin(angle), is_flat ? 0 : wave(angle)});
  }
  return Data(std::move(points));
}

TEST_F(CellMaps, CellsAroundACircleHaveNoSeam) {
  const NodePtr map = make("curve_cells", {{"points", ring(true)},
                                           {"width", Data(4.0)},
                                           {"depth", Data(6.0)},
                                           {"count", list({24, 2, 3})},
                                           {"closed", Data(true)}});
  // The curve runs as the angle does and w is up, so v is inward.
  for (const double angle : {1e-4, 10.0, 100.0, 359.9}) {
    const Vec3 p = around_z(21, angle, 1.5);
    expect_near(vector_at(map, "place", p), {angle / 15, 0.5, 2.25}, 1e-4);
    expect_near(vector_at(map, "size", p), {21 * pi / 12, 2, 2}, 1e-4);
    EXPECT_LT(of_output(map, "region", p)[0], -0.9);
  }
  EXPECT_GT(of_output(map, "region", around_z(22.1, 0, 0))[0], 0);
  const NodePtr gyroid = make("tpms", {{"map", object(map)}, {"thickness", Data(0.3)}});
  for (int n = 0; n < 60; ++n) {
    const double rho = 18.2 + 0.06 * n, z = -2.7 + 0.09 * n;
    const double before = distance(gyroid, around_z(rho, -1e-7, z));
    if (std::abs(before) > 1) continue;  // far away, where the slope vanishes, distances change fast
    EXPECT_NEAR(distance(gyroid, around_z(rho, 1e-7, z)), before, 1e-6);
  }
}

// Frames that turn around a curve shear the cells; slopes are those of differences, also at the seam.
TEST_F(CellMaps, CellsAroundAClosedCurveInSpaceMeetThemselves) {
  const NodePtr map = make("curve_cells", {{"points", ring(false)},
                                           {"width", Data(4.0)},
                                           {"depth", Data(6.0)},
                                           {"count", list({24, 2, 2})},
                                           {"closed", Data(true)}});
  constexpr double step = 1e-4;
  const auto wrapped = [](double v) { return v - 24 * std::round(v / 24); };
  for (int n = 0; n < 40; ++n) {
    const double angle = 9.0 * n + (n == 0 ? 0 : 0.5);
    const Vec3 p = around_z(20 + 1.5 * std::sin(n), angle, wave(angle * pi / 180) + 1.5 * std::cos(3 * n));
    const Vec3 slopes[] = {vector_at(map, "slope_u", p), vector_at(map, "slope_v", p), vector_at(map, "slope_w", p)};
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 by;
      by[axis] = step;
      const Vec3 change = vector_at(map, "place", p + by) - vector_at(map, "place", p - by);
      EXPECT_NEAR(slopes[0][axis], wrapped(change.x) / (2 * step), 1e-4) << n;
      EXPECT_NEAR(slopes[1][axis], change.y / (2 * step), 1e-4) << n;
      EXPECT_NEAR(slopes[2][axis], change.z / (2 * step), 1e-4) << n;
    }
    const double volume = 1 / dot(slopes[0], cross(slopes[1], slopes[2]));
    EXPECT_NEAR(number_at(map, "volume", p), volume, 1e-9 * volume);
    const Vec3 stretches = vector_at(map, "stretches", p);
    EXPECT_NEAR(stretches.x * stretches.y * stretches.z, volume, 1e-6 * volume);
  }
  const Named two{{"points", rows({{0, 0, 0}, {5, 0, 0}})}, {"closed", Data(true)}, {"size", list({2, 2, 2})}};
  EXPECT_NE(error_of("curve_cells", two).find("3 to 1000 different points"), std::string::npos);
}

TEST_F(CellMaps, ACurveThatIsTighterThanItsCellsIsRefused) {
  const Named bent{
      {"points", rows({{0, 0, 0}, {5, 0, 0}, {5, 5, 0}})}, {"width", Data(8.0)}, {"size", list({2, 2, 2})}};
  EXPECT_NE(error_of("curve_cells", bent).find("radius"), std::string::npos);
  const Named loop{{"points", rows({{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}, {0, 1, 1}, {0, -9, 1}})},
                   {"width", Data(2.0)},
                   {"depth", Data(2.0)},
                   {"size", list({2, 2, 2})}};
  EXPECT_NE(error_of("curve_cells", loop).find("overlap"), std::string::npos);
}

TEST_F(CellMaps, FormulasChangeTheSpacing) {
  const NodePtr map = make("formula_cells", {{"v", Data("v + v^2/8")}, {"of", object(pipe())}});
  const Vec3 p = around_z(9.25, 50, -3);  // v = 1.4 in the pipe
  expect_near(vector_at(map, "place", p), {50.0 / 30, 1.4 + 1.96 / 8, 1.25}, 1e-12);
  expect_near(vector_at(map, "slope_v", p), {0, 0, 0.2 * (1 + 1.4 / 4)}, 1e-12);
  EXPECT_NEAR(vector_at(map, "size", p).y, 5 / (1 + 1.4 / 4), 1e-12);
  const NodePtr plain = make("formula_cells", {{"u", Data("x*y")}, {"v", Data("y/2")}, {"w", Data("z + x")}});
  expect_near(vector_at(plain, "slope_u", {3, 5, 7}), {5, 3, 0}, 1e-12);
  EXPECT_NEAR(number_at(plain, "volume", {3, 5, 7}), 1 / (5 * 0.5), 1e-12);
  EXPECT_NE(error_of("formula_cells", {{"v", Data("v - v^2/4")}, {"of", object(pipe())}}).find("folded"),
            std::string::npos);
  EXPECT_NE(error_of("formula_cells", {{"v", Data("v - v^2/4")}}).find("no map"), std::string::npos);
}

TEST_F(CellMaps, AGyroidAroundAPipeHasNoSeam) {
  const NodePtr wall = make("tpms", {{"map", object(pipe())}, {"thickness", Data(0.3)}});
  for (int n = 0; n < 100; ++n) {
    const double rho = 8.1 + 0.018 * n, z = -9 + 0.18 * n;
    const double before = distance(wall, around_z(rho, -1e-7, z));
    if (std::abs(before) > 1) continue;  // far away, where the slope vanishes, distances change fast
    EXPECT_NEAR(distance(wall, around_z(rho, 1e-7, z)), before, 1e-6);
    EXPECT_NEAR(distance(wall, around_z(rho, 17, z)), distance(wall, around_z(rho, 17 + 30 * 7, z)), 1e-9);
    EXPECT_FALSE(inside(wall, around_z(rho + 3, 17, z)));
  }
}

// docs/user/cells.md promises this accuracy.
TEST_F(CellMaps, BentWallsHaveTheirThickness) {
  const NodePtr bent = cylinder(16, 24, 24, {12, 3, 1}), cone = make("frustum_cells", {{"inner", Data(16.0)},
                                                                                       {"outer", Data(24.0)},
                                                                                       {"inner_top", Data(20.0)},
                                                                                       {"outer_top", Data(25.0)},
                                                                                       {"height", Data(24.0)},
                                                                                       {"count", list({12, 3, 1})}});
  for (const NodePtr& map : {bent, cone})
    for (const std::string type : {"tpms", "plates", "folds"}) {
      const double thickness = 0.2;
      Named sheet{{"map", object(map)}, {"thickness", Data(thickness)}};
      if (type == "plates") sheet.push_back({"kind", Data("octet")});
      if (type == "folds") {
        sheet.push_back({"profile", Data("round")});
        sheet.push_back({"creases", Data("curved")});
      }
      const NodePtr wall = make(type, sheet);
      int tried = 0;
      while (tried < 12) {
        Vec3 p = random_point(22);
        if (of_output(map, "region", p)[0] > -1.5) continue;
        // Steps into the wall, off its middle, where the normal jumps.
        for (int n = 0; n < 12; ++n) p = p - (distance(wall, p) + thickness / 4) * normal(wall, p);
        const bool is_in_wall = std::abs(distance(wall, p) + thickness / 4) < 0.02 * thickness;
        if (of_output(map, "region", p)[0] > -1 || !is_in_wall) continue;
        const Vec3 n = normal(wall, p);
        const double measured = way_out(wall, p, n, 2 * thickness) + way_out(wall, p, -n, 2 * thickness);
        if (measured > 1.5 * thickness) continue;  // a joint of plates
        EXPECT_NEAR(measured, thickness, 0.02 * thickness) << type;
        ++tried;
      }
    }
}

// Walls of cubic plates leave cubes free; regular hexagons leave hexagons free.
TEST_F(CellMaps, FlatWallsFillTheirShare) {
  const NodePtr cells = box({4, 4 * std::sqrt(3), 5});
  const NodePtr comb = make("honeycomb", {{"map", object(cells)}, {"thickness", Data(0.8)}});
  const NodePtr cubes = make("plates", {{"map", object(box({4, 4, 4}))}, {"thickness", Data(0.8)}});
  constexpr int side = 20;  // the faces of plates lie between two of these points
  int in_comb = 0, in_cubes = 0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < side; ++k) {
        const Vec3 f{(i + 0.5) / side, (j + 0.5) / side, (k + 0.5) / side};
        if (k == 0) in_comb += inside(comb, {4 * f.x, 4 * std::sqrt(3) * f.y, 1}) ? 1 : 0;
        in_cubes += inside(cubes, 4.0 * f) ? 1 : 0;
      }
  EXPECT_NEAR(in_comb / (1.0 * side * side), 1 - 0.8 * 0.8, 0.03);
  EXPECT_NEAR(in_cubes / (1.0 * side * side * side), 1 - std::pow(0.8, 3), 1e-9);
}

// Compares with the nearest of all walls around the cell.
TEST_F(CellMaps, ReentrantWallsAreSegmentsThatRepeat) {
  const double angle = -25 * pi / 180, ratio = 1.6, height = 2 * (ratio + std::sin(angle)), width = 2 * std::cos(angle);
  const NodePtr comb = make("honeycomb", {{"map", object(box({width, height, 1}))},
                                          {"thickness", Data(0.1)},
                                          {"angle", Data(-25.0)},
                                          {"ratio", Data(ratio)}});
  const auto from_segment = [](double x, double y, Vec3 a, Vec3 b) {
    const Vec3 p = Vec3{x, y, 0} - a, way = b - a;
    const double t = std::clamp(dot(p, way) / dot(way, way), 0.0, 1.0);
    return length(p - t * way);
  };
  for (int n = 0; n < 200; ++n) {
    const Vec3 p = random_point(6);
    double best = 1e9;
    for (int i = -5; i <= 5; ++i)
      for (int j = -5; j <= 5; ++j) {
        // The walls around the middle of a cell: an upright one at the side, slanted ones to the middle line.
        const double cx = (i + 0.5) * width, cy = (j + 0.5) * height, rise = ratio / 2 + std::sin(angle);
        for (const double sx : {-1.0, 1.0}) {
          const double x = cx + sx * width / 2;
          best = std::min(best, from_segment(p.x, p.y, {x, cy - ratio / 2, 0}, {x, cy + ratio / 2, 0}));
          for (const double sy : {-1.0, 1.0}) {
            best = std::min(best, from_segment(p.x, p.y, {x, cy + sy * ratio / 2, 0}, {cx, cy + sy * rise, 0}));
            best = std::min(best, from_segment(p.x, p.y, {cx, cy + sy * rise, 0}, {cx, cy + sy * height / 2, 0}));
          }
        }
      }
    EXPECT_NEAR(distance(comb, p), best - 0.05, 1e-9);
  }
}

TEST_F(CellMaps, StrutsOnBoxesAreThoseOfTiles) {
  for (const std::string cell : {"bcc", "octet", "kelvin", "diamond"}) {
    const NodePtr on_map =
        make("lattice", {{"cell", Data(cell)}, {"radius", Data(0.3)}, {"map", object(box({4, 5, 6}))}});
    const NodePtr unit = make("lattice", {{"cell", Data(cell)}, {"radius", Data(0.3)}, {"size", list({4, 5, 6})}});
    const NodePtr tiles = make("tile", {}, {unit});
    for (int n = 0; n < 50; ++n) {
      const Vec3 p = random_point(15);
      EXPECT_NEAR(distance(on_map, p), distance(tiles, p - Vec3{2, 2.5, 3}), 1e-9) << cell;
    }
  }
}

// One diagonal in each cell makes lines through all of space, at equal distances from each other.
TEST_F(CellMaps, StrutsOfAGraphReachIntoTheNeighbours) {
  const Data edge(DataList{Data(DataList{list({0, 0, 0}), list({1, 1, 1})})});
  const NodePtr lines = make("lattice", {{"edges", edge}, {"radius", Data(0.3)}, {"map", object(box({4, 4, 4}))}});
  for (int n = 0; n < 200; ++n) {
    const Vec3 p = random_point(15);
    double best = 1e9;
    for (int i = -10; i <= 10; ++i)
      for (int j = -10; j <= 10; ++j) {
        const Vec3 off = p - Vec3{4.0 * i, 4.0 * j, 0}, along = (1 / std::sqrt(3.0)) * Vec3{1, 1, 1};
        best = std::min(best, length(off - dot(off, along) * along));
      }
    EXPECT_NEAR(distance(lines, p), best - 0.3, 1e-9);
  }
}

TEST_F(CellMaps, JointsAreBallsAtTheEndsOfStruts) {
  const NodePtr lattice =
      make("lattice",
           {{"cell", Data("cubic")}, {"radius", Data(0.3)}, {"joint", Data(0.8)}, {"map", object(box({4, 5, 6}))}});
  EXPECT_NEAR(distance(lattice, {4.4, 5.4, 6.4}), std::sqrt(3 * 0.4 * 0.4) - 0.8, 1e-9);
  EXPECT_NEAR(distance(lattice, {4, 5, 9}), -0.3, 1e-9);
  EXPECT_NE(error_of("lattice", {{"cell", Data("bcc")}, {"joint", Data(1.0)}}).find("no map of cells"),
            std::string::npos);
  const Data far(DataList{Data(DataList{list({0, 0, 0}), list({2, 1, 1})})});
  EXPECT_NE(error_of("lattice", {{"edges", far}, {"map", object(pipe())}}).find("leaves the cell"), std::string::npos);
}

// Three lines through each corner of cells: seams have the fillet of union, and struts in line have no seam.
TEST_F(CellMaps, SeamsOfStrutsHaveFillets) {
  for (const std::string kind : {"cell", "edges"}) {
    Named with{{"radius", Data(1.0)}, {"blend", Data(1.5)}, {"map", object(box({12, 12, 12}))}};
    const auto edge = [](double x, double y, double z) { return Data(DataList{list({0, 0, 0}), list({x, y, z})}); };
    if (kind == "cell")
      with.push_back({"cell", Data("cubic")});
    else
      with.push_back({"edges", Data(DataList{edge(1, 0, 0), edge(0, 1, 0), edge(0, 0, 1)})});
    const NodePtr lattice = make("lattice", with);
    for (int n = 0; n < 200; ++n) {
      const Vec3 p = random_point(18);
      const Vec3 q{std::remainder(p.x, 12), std::remainder(p.y, 12), std::remainder(p.z, 12)};
      const std::array distances{std::hypot(q.y, q.z) - 1, std::hypot(q.z, q.x) - 1, std::hypot(q.x, q.y) - 1};
      double total = 0;
      for (const double d : distances) total += std::pow(std::max(1.5 - d, 0.0), 2);
      const double least = std::min({distances[0], distances[1], distances[2]});
      // Farther struts, which only the least distance could name, are left out.
      if (least > 3) continue;
      EXPECT_NEAR(distance(lattice, p), std::max(1.5, least) - std::sqrt(total), 1e-9) << kind;
    }
  }
  EXPECT_NE(error_of("lattice", {{"cell", Data("bcc")}, {"blend", Data(1.0)}}).find("no map of cells"),
            std::string::npos);
  EXPECT_NE(
      error_of(
          "lattice",
          {{"cell", Data("bcc")}, {"blend", Data(1.0)}, {"radius", Data("1 + t")}, {"map", object(box({9, 9, 9}))}})
          .find("leave out t"),
      std::string::npos);
}

// The function of Schwarz' P surface as a formula makes the walls that the named surface has.
TEST_F(CellMaps, FormulasAreSurfaces) {
  const Data formula("cos(2*pi*u) + cos(2*pi*v) + cos(2*pi*w)");
  const NodePtr known = make("tpms", {{"surface", Data("schwarz_p")}, {"map", object(pipe())}});
  const NodePtr own = make("tpms", {{"equation", formula}, {"map", object(pipe())}});
  for (int n = 0; n < 50; ++n) {
    const Vec3 p = around_z(8.2 + 0.03 * n, 7.1 * n, 0.3 * n - 7);
    EXPECT_NEAR(distance(own, p), distance(known, p), 1e-9);
  }
  EXPECT_NE(error_of("tpms", {{"equation", formula}, {"density", Data(0.3)}}).find("is not known"), std::string::npos);
}

// The edges of cells along the axis of a pipe are straight lines.
TEST_F(CellMaps, StrutsInAPipeHaveTheirRadius) {
  const NodePtr lattice = make(
      "lattice", {{"cell", Data("cubic")}, {"radius", Data(0.4)}, {"map", object(cylinder(16, 24, 24, {12, 3, 2}))}});
  const Vec3 middle = around_z(20, 60, 0.1);  // on the border of two cells, and in the middle of one along the axis
  for (const double angle : {0.0, 40.0, 100.0, 170.0, 230.0, 310.0}) {
    const Vec3 direction = around_z(1, angle, 0);
    EXPECT_NEAR(way_out(lattice, middle, direction, 1), 0.4, 0.02 * 0.4) << angle;
  }
}

TEST_F(CellMaps, SaysWhatIsMissing) {
  EXPECT_NE(error_of("cylinder_cells", {}).find("neither the size nor the numbers"), std::string::npos);
  EXPECT_NE(error_of("cylinder_cells", {{"count", list({1, 1, 1})}, {"inner", Data(0.0)}}).find("inner"),
            std::string::npos);
  EXPECT_NE(error_of("tpms", {{"map", object(make("noise", {}))}}).find("a map of cells"), std::string::npos);
  EXPECT_NE(error_of("tpms", {{"map", object(pipe())}, {"cell", list({1, 1, 1})}}).find("leave out cell"),
            std::string::npos);
  EXPECT_NE(error_of("honeycomb", {{"map", object(pipe())}, {"angle", Data(-60.0)}}).find("would cross"),
            std::string::npos);
}

}  // namespace ombre::nodes
