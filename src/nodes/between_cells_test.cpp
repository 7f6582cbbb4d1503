// Compares cells between two balls with formulas of their distances.
#include "nodes/test_values.h"

namespace ombre::nodes {
namespace {

using namespace test;

constexpr Vec3 off_centre{1, 0, 0};

class BetweenCells : public ValueTest {
 protected:
  NodePtr ball(double radius, Vec3 centre = {}) {
    return make("translate", {{"by", list({centre.x, centre.y, centre.z})}},
                {make("sphere", {{"radius", Data(radius)}})});
  }
  // Twelve cells around and four from the latitude -60 to 60.
  NodePtr around() {
    return make("ball_cells", {{"inner", Data(2.0)},
                               {"outer", Data(14.0)},
                               {"south", Data(-60.0)},
                               {"north", Data(60.0)},
                               {"count", list({12, 4, 1})}});
  }
  Named between(const NodePtr& inner, const NodePtr& outer, const NodePtr& of, double layers = 1) {
    return {{"inner", object(inner)}, {"outer", object(outer)}, {"of", object(of)}, {"layers", Data(layers)}};
  }

  double to_edge(const NodePtr& solid, Vec3 p, Vec3 direction) {
    double in = 0, out = 1;
    for (int n = 0; n < 40; ++n) (distance(solid, p + 0.5 * (in + out) * direction) <= 0 ? in : out) = 0.5 * (in + out);
    return in;
  }
};

}  // namespace

TEST_F(BetweenCells, BallsAroundOneCentreHaveTheCellsOfAHollowBall) {
  const NodePtr map = make("between_cells", between(ball(8), ball(12), around(), 3));
  const Vec3 p{3, 6, 7};
  const double r = length(p);
  const Vec3 known = vector_at(around(), "place", p);
  expect_near(vector_at(map, "place", p), {known.x, known.y, (r - 8) / 4 * 3}, 1e-12);
  expect_near(vector_at(map, "slope_w", p), (0.75 / r) * p, 1e-9);
  expect_near(vector_at(map, "slope_u", p), vector_at(around(), "slope_u", p), 1e-12);
  EXPECT_NEAR(number_at(map, "gap", p), 4, 1e-12);
  EXPECT_NEAR(vector_at(map, "size", p).z, 4.0 / 3, 1e-9);
  EXPECT_LE(of_output(map, "region", p)[0], 0);
  for (const Vec3 outside : {Vec3{3, 3, 3}, Vec3{9, 9, 3}, Vec3{0, 0, 10}})
    EXPECT_GT(of_output(map, "region", outside)[0], 0);
}

TEST_F(BetweenCells, WIsTheShareOfBothDistances) {
  const NodePtr map = make("between_cells", between(ball(5, off_centre), ball(10), around(), 2));
  const Vec3 p{-2, 6, 3}, from_centre = p - off_centre;
  const double a = length(from_centre) - 5, b = 10 - length(p);
  EXPECT_NEAR(vector_at(map, "place", p).z, 2 * a / (a + b), 1e-12);
  EXPECT_NEAR(number_at(map, "gap", p), a + b, 1e-12);
  const Vec3 of_a = (1 / length(from_centre)) * from_centre, of_b = (-1 / length(p)) * p;
  expect_near(vector_at(map, "slope_w", p), (2 / ((a + b) * (a + b))) * (b * of_a - a * of_b), 1e-9);
}

// Where the space is narrow and where it is wide, walls between two layers are equally thick.
TEST_F(BetweenCells, WallsHaveTheirThickness) {
  const NodePtr map = make("between_cells", between(ball(5, off_centre), ball(10), around(), 2));
  const double thickness = 0.3;
  const NodePtr wall = make("plates", {{"map", object(map)}, {"thickness", Data(thickness)}});
  for (const double degrees : {15.0, 75.0, 135.0, 165.0, 255.0}) {
    const double latitude = 15 * pi / 180, turn = degrees * pi / 180;  // the middle of a cell along u and v
    const Vec3 ray{std::cos(latitude) * std::cos(turn), std::cos(latitude) * std::sin(turn), std::sin(latitude)};
    double low = 6, high = 10;
    for (int n = 0; n < 40; ++n)
      (vector_at(map, "place", 0.5 * (low + high) * ray).z < 1 ? low : high) = 0.5 * (low + high);
    const Vec3 p = low * ray, slope = vector_at(map, "slope_w", p), n = (1 / length(slope)) * slope;
    EXPECT_NEAR(to_edge(wall, p, n) + to_edge(wall, p, -n), thickness, 0.01 * thickness) << degrees;
  }
}

TEST_F(BetweenCells, RefusesWhatHasNoCells) {
  EXPECT_NE(error_of("between_cells", between(ball(10), ball(5), around())).find("no space lies between"),
            std::string::npos);
  const NodePtr flat = make("box_cells", {{"size", list({3, 3, 3})}});
  EXPECT_NE(error_of("between_cells", between(ball(5), ball(10), flat)).find("cells of between_cells are folded"),
            std::string::npos);
  EXPECT_NE(error_of("between_cells", between(ball(5), ball(6, {50, 0, 0}), around())).find("outside of the region"),
            std::string::npos);
  EXPECT_NE(error_of("between_cells", {{"inner", object(ball(5))}, {"outer", object(ball(6))}}).find("of"),
            std::string::npos);
}

}  // namespace ombre::nodes
