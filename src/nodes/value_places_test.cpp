// Compares positions, cells and noise with mathematics and exhaustive searches.
#include "nodes/test_values.h"

namespace ombre::nodes {
namespace {

using namespace test;

class ValuePlaces : public ValueTest {};

}  // namespace

TEST_F(ValuePlaces, CoordinatesAreThoseOfTheFrame) {
  const NodePtr frame =
      make("coordinates", {{"origin", list({1, 2, 3})}, {"axis", list({1, 0, 0})}, {"toward", list({0, 2, 0})}});
  // The frame's x is y, its y is z, its z is x.
  expect_near(vector_at(frame, "place", {5, 7, 4}), {5, 1, 4}, 1e-12);
  EXPECT_NEAR(number_at(frame, "rho", {5, 7, 4}), std::sqrt(26), 1e-12);
  EXPECT_NEAR(number_at(frame, "azimuth", {5, 7, 4}), std::atan2(1, 5) * 180 / pi, 1e-10);
  EXPECT_NEAR(number_at(frame, "height", {5, 7, 4}), 4, 1e-12);
  EXPECT_NEAR(number_at(frame, "r", {5, 7, 4}), std::sqrt(42), 1e-12);
  EXPECT_NEAR(number_at(frame, "polar", {5, 7, 4}), std::acos(4 / std::sqrt(42)) * 180 / pi, 1e-10);
}

TEST_F(ValuePlaces, AValueAtAnotherPlaceIsTheValueThere) {
  const NodePtr noise = make("noise", {{"size", Data(3.0)}});
  const NodePtr moved =
      make("at", {{"value", object(noise)}, {"place", Data(DataList{Data("2*x"), Data("y + 1"), Data("z - x")})}});
  for (int n = 0; n < 50; ++n) {
    const Vec3 p = random_point(20);
    EXPECT_NEAR(number_at(moved, "value", p), number_at(noise, "value", {2 * p.x, p.y + 1, p.z - p.x}), 1e-12);
  }
}

TEST_F(ValuePlaces, DistancesToASolidAreItsOwn) {
  const NodePtr ball = make("sphere", {{"radius", Data(4.0)}});
  const NodePtr distance = make("distance_to", {{"solid", object(ball)}});
  const NodePtr soft = make("mask", {{"solid", object(ball)}, {"width", Data(2.0)}}),
                hard = make("mask", {{"solid", object(ball)}});
  for (int n = 0; n < 50; ++n) {
    const Vec3 p = random_point(8);
    const double d = length(p) - 4;
    EXPECT_NEAR(number_at(distance, "distance", p), d, 1e-12);
    EXPECT_EQ(number_at(distance, "inside", p), d <= 0);
    expect_near(vector_at(distance, "normal", p), (1 / length(p)) * p, 1e-4);
    expect_near(vector_at(distance, "nearest", p), (4 / length(p)) * p, 1e-3);
    EXPECT_NEAR(number_at(soft, "value", p), std::clamp(0.5 - d / 2, 0.0, 1.0), 1e-12);
    EXPECT_EQ(number_at(hard, "value", p), d <= 0);
  }
}

// Along a trefoil, whose frames would not meet if they were only transported.
TEST_F(ValuePlaces, FramesOfClosedCurvesMeetAtTheStart) {
  const auto trefoil = [](double turns) {
    const double t = 2 * pi * turns, rho = 4 * (2 + std::cos(3 * t));
    return Vec3{rho * std::cos(2 * t), rho * std::sin(2 * t), 4 * std::sin(3 * t)};
  };
  DataList points;
  constexpr int count = 90, steps = 2000;
  for (int n = 0; n < count; ++n) {
    const Vec3 p = trefoil(static_cast<double>(n) / count);
    points.emplace_back(list({p.x, p.y, p.z}));
  }
  const NodePtr curve = make("curve_distance", {{"points", Data(points)}, {"closed", Data(true)}});
  Vec3 before = vector_at(curve, "normal", trefoil(-0.5 / steps));
  for (int n = 0; n < steps; ++n) {
    const Vec3 p = trefoil((n + 0.5) / steps), normal = vector_at(curve, "normal", p);
    EXPECT_NEAR(length(normal), 1, 1e-9);
    EXPECT_NEAR(dot(normal, vector_at(curve, "tangent", p)), 0, 1e-9);
    EXPECT_LT(length(normal - before), 0.02) << n;
    EXPECT_LT(number_at(curve, "distance", p), 1e-3);
    EXPECT_NEAR(number_at(curve, "along", p), (n + 0.5) / steps, 0.04);  // its speed varies
    before = normal;
  }
}

// The principal normal of a helix points to its axis.
TEST_F(ValuePlaces, NormalsOfFrenetPointToTheCentreOfCurvature) {
  const auto helix = [](double t) { return Vec3{6 * std::cos(t), 6 * std::sin(t), 2 * t}; };
  DataList points;
  for (int n = 0; n <= 80; ++n) {
    const Vec3 p = helix(0.1 * n);
    points.emplace_back(list({p.x, p.y, p.z}));
  }
  const NodePtr curve = make("curve_distance", {{"points", Data(points)}, {"frame", Data("frenet")}});
  for (int n = 0; n < 50; ++n) {
    const double t = 2 + 0.08 * n;
    expect_near(vector_at(curve, "normal", helix(t)), {-std::cos(t), -std::sin(t), 0}, 0.01);
  }
  const NodePtr line = make("curve_distance", {{"points", rows({{0, 0, 0}, {5, 0, 0}})}, {"frame", Data("frenet")}});
  expect_near(vector_at(line, "normal", {2, 1, 1}), {0, 0, 1}, 1e-12);  // no curvature: that of `toward`
}

TEST_F(ValuePlaces, ClosedCurvesNeedThreePoints) {
  EXPECT_NE(error_of("curve_distance", {{"points", rows({{0, 0, 0}, {5, 0, 0}, {0, 0, 0}})}, {"closed", Data(true)}})
                .find("curve_distance needs 3 to 1000 different points"),
            std::string::npos);
}

// Compares with the nearest centre, corners and sides among all hexagons around the point.
TEST_F(ValuePlaces, HexagonsAreThoseOfTheNearestMiddle) {
  constexpr double width = 3;
  const NodePtr cells = make("hex_cells", {{"size", Data(width)}});
  for (int n = 0; n < 200; ++n) {
    const Vec3 p = random_point(9);
    double best = 1e9;
    Vec3 middle;
    for (int q = -20; q <= 20; ++q)
      for (int r = -20; r <= 20; ++r) {
        const Vec3 at{width * (q + 0.5 * r), width * std::sqrt(3) / 2 * r, 0};
        const double away = std::hypot(p.x - at.x, p.y - at.y);
        if (away < best) {
          best = away;
          middle = at;
        }
      }
    const Vec3 index = vector_at(cells, "index", p);
    EXPECT_NEAR(width * (index.x + 0.5 * index.y), middle.x, 1e-9);
    EXPECT_NEAR(width * std::sqrt(3) / 2 * index.y, middle.y, 1e-9);
    double border = 1e9, corner = 1e9;
    for (int side = 0; side < 6; ++side) {
      const double a = side * pi / 3, c = a + pi / 6, x = p.x - middle.x, y = p.y - middle.y;
      border = std::min(border, width / 2 - (x * std::cos(a) + y * std::sin(a)));
      corner =
          std::min(corner, std::hypot(x - width / std::sqrt(3) * std::cos(c), y - width / std::sqrt(3) * std::sin(c)));
    }
    EXPECT_NEAR(number_at(cells, "distance", p), border, 1e-9);
    EXPECT_NEAR(number_at(cells, "corner", p), corner, 1e-9);
  }
}

TEST_F(ValuePlaces, TrianglesHaveTheLinesOfThreeDirectionsAsBorders) {
  constexpr double side = 4, height = side * 0.8660254037844386;
  const NodePtr cells = make("triangle_cells", {{"size", Data(side)}});
  for (int n = 0; n < 200; ++n) {
    const Vec3 p = random_point(15);
    double border = 1e9;
    for (int line = 0; line < 3; ++line) {
      const double a = pi / 2 + line * pi / 3;
      border = std::min(border, std::abs(std::remainder(p.x * std::cos(a) + p.y * std::sin(a), height)));
    }
    EXPECT_NEAR(number_at(cells, "distance", p), border, 1e-9);
    const Vec3 shares = vector_at(cells, "local", p);
    EXPECT_NEAR(shares.x + shares.y + shares.z, 1, 1e-9);
  }
}

// Tetrahedra are bounded by the planes x = y, y = z, z = x and the faces of the cubes.
TEST_F(ValuePlaces, TetrahedraHaveSixPlanesAsBorders) {
  constexpr double size = 3;
  const NodePtr cells = make("tetrahedron_cells", {{"size", Data(size)}});
  for (int n = 0; n < 200; ++n) {
    const Vec3 p = random_point(9);
    const Vec3 u{p.x / size - std::floor(p.x / size), p.y / size - std::floor(p.y / size),
                 p.z / size - std::floor(p.z / size)};
    std::array<double, 3> sorted{u.x, u.y, u.z};
    std::sort(sorted.begin(), sorted.end());
    const double expected = size * std::min({sorted[0], 1 - sorted[2], (sorted[1] - sorted[0]) / std::sqrt(2),
                                             (sorted[2] - sorted[1]) / std::sqrt(2)});
    EXPECT_NEAR(number_at(cells, "distance", p), expected, 1e-9);
    const double which = number_at(cells, "which", p);
    const int first = u.x >= u.y && u.x >= u.z ? 0 : u.y >= u.z ? 1 : 2;
    EXPECT_EQ(std::floor(which / 2), first);
  }
}

// Points up to the border's distance lie in the same cell; just beyond it, at least one direction leads to another
// cell.
TEST_F(ValuePlaces, VoronoiCellsEndAtTheirBorders) {
  const NodePtr cells = make("voronoi_cells", {{"size", Data(2.0)}, {"seed", Data(3.0)}});
  for (int n = 0; n < 20; ++n) {
    const Vec3 p = random_point(10);
    const double border = number_at(cells, "distance", p), index = number_at(cells, "index", p);
    const Vec3 local = vector_at(cells, "local", p);
    EXPECT_NEAR(length(local), number_at(cells, "point", p), 1e-12);
    bool leaves = false;
    for (int k = 0; k < 400; ++k) {
      Vec3 way = random_point(1);
      if (length(way) < 1e-3) continue;
      way = (1 / length(way)) * way;
      EXPECT_EQ(number_at(cells, "index", p + 0.999 * border * way), index);
      leaves = leaves || number_at(cells, "index", p + (1.1 * border + 0.02) * way) != index;
    }
    EXPECT_TRUE(leaves);
  }
}

TEST_F(ValuePlaces, RandomNumbersAreThoseOfTheCell) {
  const NodePtr random = make(
      "random",
      {{"index", Data(DataList{Data("floor(x)"), Data("floor(y)"), Data(0.0)})}, {"lo", Data(2.0)}, {"hi", Data(4.0)}});
  double sum = 0, squares = 0;
  constexpr int count = 3000;
  const int side = 55;
  for (int n = 0; n < count; ++n) {
    const double x = n % side, y = n / side;
    const double v = number_at(random, "value", {x + 0.1, y + 0.7, 3});
    if (n % 50 == 0) {
      EXPECT_EQ(v, number_at(random, "value", {x + 0.8, y + 0.2, -9}));
    }
    EXPECT_GE(v, 2);
    EXPECT_LE(v, 4);
    sum += v;
    squares += (v - 3) * (v - 3);
  }
  // A uniform distribution of width 2 has the variance 1/3.
  EXPECT_NEAR(sum / count, 3, 4 * std::sqrt(1.0 / 3 / count));
  EXPECT_NEAR(squares / count, 1.0 / 3, 0.03);
}

TEST_F(ValuePlaces, NoisesOfAllKindsStayWithinTheirRangeAndRepeat) {
  for (const char* kind : {"gradient", "simplex", "cellular"})
    for (const bool turbulence : {false, true})
      for (const double octaves : {1.0, 3.0}) {
        Named values{
            {"size", Data(2.0)}, {"kind", Data(kind)}, {"octaves", Data(octaves)}, {"turbulence", Data(turbulence)}};
        const bool repeats = std::string(kind) != "simplex";
        if (repeats) values.emplace_back("period", Data(5.0));
        const NodePtr noise = make("noise", values);
        double least = 1, greatest = 0, sum = 0;
        for (int n = 0; n < 300; ++n) {
          const Vec3 p = random_point(40);
          const double v = number_at(noise, "value", p);
          least = std::min(least, v);
          greatest = std::max(greatest, v);
          sum += v / 300;
          if (repeats && n < 20) {
            EXPECT_NEAR(v, number_at(noise, "value", p + Vec3{10, -20, 30}), 1e-9) << kind;
          }
        }
        EXPECT_GE(least, 0);
        EXPECT_LE(greatest, 1);
        EXPECT_GT(greatest - least, 0.15) << kind;
        if (!turbulence && std::string(kind) != "cellular") {
          EXPECT_NEAR(sum, 0.5, 0.05) << kind;
        }
      }
}

TEST_F(ValuePlaces, SlopesOfSummedNoisesMatchDifferences) {
  const NodePtr noise = make("noise", {{"size", Data(3.0)}, {"octaves", Data(3.0)}, {"gain", Data(0.4)}});
  constexpr double h = 1e-5;
  for (int n = 0; n < 20; ++n) {
    const Vec3 p = random_point(30), slope = vector_at(noise, "slope", p);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 step;
      step[axis] = h;
      const double rise = number_at(noise, "value", p + step) - number_at(noise, "value", p - step);
      EXPECT_NEAR(slope[axis], rise / (2 * h), 1e-6);
    }
  }
}

}  // namespace ombre::nodes
