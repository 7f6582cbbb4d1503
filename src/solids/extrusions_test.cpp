// Tests of the volumes of extrusions, against mathematics and Debian's openscad 2021.01.
#include "solids/test_trees.h"

namespace ombre::solids {
namespace {

class Extrusions : public KernelTest {};

// The expected volumes are from Debian's openscad 2021.01.
TEST_F(Extrusions, AlongALine) {
  const auto by = [](LinearExtrude extrusion, const TreePtr& of) { return size_of(node(extrusion, {of})); };
  LinearExtrude plain;
  plain.height = 10;
  EXPECT_NEAR(by(plain, square(5, 5)), 250, 1e-7);
  LinearExtrude twisted = plain;
  twisted.twist = 90;
  EXPECT_SIZE(by(twisted, square(5, 5)), 264.6563371);
  twisted.fragments.count = 20;
  EXPECT_SIZE(by(twisted, square(5, 5)), 271.6727007);
  twisted.slices = 3;
  EXPECT_SIZE(by(twisted, square(5, 5)), 280.5023101);
  LinearExtrude both = plain;
  both.twist = 30;
  both.scale = {2, 2};
  EXPECT_SIZE(by(both, square(5, 5)), 597.0404312);
  LinearExtrude scaled = plain;
  scaled.scale = {2, 2};
  EXPECT_NEAR(by(scaled, square(5, 5)), 583.3333333, 1e-6);
  scaled.scale = {2, 1};
  EXPECT_NEAR(by(scaled, square(5, 5)), 375, 1e-6);
  scaled.scale = {0, 0};
  EXPECT_NEAR(by(scaled, square(5, 5)), 250.0 / 3, 1e-6);
  scaled.scale = {0, 1};
  EXPECT_NEAR(by(scaled, square(5, 5)), 125, 1e-6);
  LinearExtrude leaning = plain;
  leaning.direction = {1, 0, 1};
  EXPECT_NEAR(by(leaning, square(5, 5)), 250 / std::sqrt(2.0), 1e-6);
  LinearExtrude flat;
  flat.height = 0;
  EXPECT_EQ(by(flat, square(5, 5)), 0);
  EXPECT_NEAR(by(plain, difference({square(5, 5), moved(1, 1, 0, {square(1, 1)}), moved(3, 3, 0, {square(1, 1)})})),
              230, 1e-6);
}

// The expected volumes are from Debian's openscad 2021.01.
TEST_F(Extrusions, AreSlicedWhereTheyNarrow) {
  const TreePtr triangle = node(Polygon{{{1, 1}, {5, 1}, {3, 5}}, {}});
  const auto by = [&](double twist, Vec2 scale, double edges = 0) {
    LinearExtrude extrusion;
    extrusion.height = 10;
    extrusion.twist = twist;
    extrusion.scale = scale;
    extrusion.fragments.count = edges;
    return size_of(node(extrusion, {triangle}));
  };
  EXPECT_SIZE(by(0, {1, 2}, 8), 118.333333);
  EXPECT_SIZE(by(0, {1, 2}, 20), 119.333333);
  EXPECT_SIZE(by(-60, {1, 1}, 20), 75.640471);
  EXPECT_SIZE(by(60, {1, 3}), 154.926005);
  EXPECT_SIZE(by(60, {0, 0}), 27.3672769);
  EXPECT_SIZE(by(60, {3, 3}), 361.969694);
  EXPECT_SIZE(by(400, {3, 3}), 337.619056);
}

// Walls of holes and of outlines are cut along different diagonals if both are equally long. The longer ones count if
// the last slice is a line. The expected volumes are from Debian's openscad 2021.01.
TEST_F(Extrusions, HaveTheDiagonalsOfOpenScad) {
  LinearExtrude twisted;
  twisted.height = 10;
  twisted.twist = 30;
  twisted.slices = 1;
  const auto frame = [](double x, double y) {
    return difference({moved(-5, -5, 0, {square(10, 10)}), moved(x, y, 0, {square(3, 3)})});
  };
  EXPECT_SIZE(size_of(node(twisted, {frame(0, 0)})), 1021.02815);
  EXPECT_SIZE(size_of(node(twisted, {frame(0, 1)})), 1028.52821);
  EXPECT_SIZE(size_of(node(twisted, {difference({moved(-1, -1, 0, {square(10, 10)}), square(8, 8)})})), 403.92261);
  LinearExtrude wedge;
  wedge.height = 10;
  wedge.scale = {1, 0};
  const TreePtr triangle = node(Polygon{{{20, 0}, {0, 10}, {0, -10}}, {}});
  for (const auto& [slices, volume] : {std::pair(1, 4000.0 / 3), std::pair(2, 1000.0)}) {
    wedge.slices = slices;
    EXPECT_NEAR(size_of(node(wedge, {triangle})), volume, 1e-6);
  }
  wedge.slices = 1;
  EXPECT_SIZE(size_of(node(wedge, {node(Polygon{{{20, 3}, {20, -2}, {1, -10}, {0, 10}}, {}})})), 1446.66667);
}

// A corner that goes straight on would give the sides of a twisted extrusion other slices. The volume is that of
// OpenSCAD 2021.01.
TEST_F(Extrusions, UnitedDrawingsHaveNoStraightCorners) {
  const TreePtr wide = unite({moved(-0.5, 0, 0, {square(1, 1)}), moved(0.5, 0, 0, {square(1, 1)})});
  Diagnostics messages;
  const Pieces pieces = evaluate(wide, {}, messages);
  ASSERT_EQ(pieces.size(), 1U);
  ASSERT_EQ(pieces[0].region()->rings.size(), 1U);
  EXPECT_EQ(pieces[0].region()->rings[0].size(), 4U);
  LinearExtrude twisted;
  twisted.height = 3;
  twisted.twist = 180;
  twisted.slices = 4;
  twisted.scale = {0.5, 1};
  EXPECT_NEAR(size_of(node(twisted, {wide})), 5.07713, 1e-4);
}

// The walls inside and outside meet in one point: a pyramid of 4 less one of 1.
TEST_F(Extrusions, FramesThatNarrowToAPointAreCombined) {
  LinearExtrude narrowing;
  narrowing.height = 3;
  narrowing.scale = {0, 0};
  const TreePtr frame =
      node(narrowing, {difference({moved(-1, -1, 0, {square(2, 2)}), moved(-0.5, -0.5, 0, {square(1, 1)})})});
  EXPECT_NEAR(size_of(frame), 3, 1e-9);
  EXPECT_NEAR(size_of(unite({frame, moved(-0.25, -0.25, -1, {cube(0.5, 0.5, 1.5)})})), 3.375, 1e-9);
  EXPECT_NEAR(size_of(difference({frame, moved(0, -2, -1, {cube(4, 4, 5)})})), 1.5, 1e-9);
}

// The expected volumes are from Debian's openscad 2021.01.
TEST_F(Extrusions, AroundAnAxis) {
  const auto by = [](RotateExtrude extrusion, const TreePtr& of) { return size_of(node(extrusion, {of})); };
  const TreePtr ring = moved(2, 0, 0, {square(1, 1)});
  EXPECT_SIZE(by({360, 180, 2, {}}, ring), 14.6946765);
  EXPECT_SIZE(by({90, 0, 2, {}}, ring), 3.53554);
  EXPECT_SIZE(by({360, 180, 2, {}}, moved(2, 0, 0, {circle(1, 0)})), 27.9509086);
  EXPECT_SIZE(by({100, 0, 2, {7}}, moved(2, 0, 0, {circle(1, 5)})), 4.6830415);
  EXPECT_SIZE(by({-100, 0, 2, {7}}, moved(2, 0, 0, {circle(1, 5)})), 4.6830415);
  EXPECT_SIZE(by({360, 180, 2, {7}}, moved(-2, 0, 0, {circle(1, 5)})), 26.0248563);
  EXPECT_SIZE(by({360, 180, 2, {7}}, square(3, 3)), 73.8830164);
  EXPECT_SIZE(by({360, 180, 2, {2}}, square(3, 3)), 35.07408);
}

}  // namespace
}  // namespace ombre::solids
