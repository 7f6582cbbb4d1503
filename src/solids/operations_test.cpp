// Tests of the sizes of results, against mathematics, and against OpenSCAD 2021.01 where it decides how circles are
// divided.
#include <fstream>
#include <numbers>
#include <random>

#include "solids/test_trees.h"

namespace ombre::solids {
namespace {

constexpr double pi = std::numbers::pi;

class Operations : public KernelTest {};

// Returns the area of a regular polygon inscribed in a circle.
double polygon_area(double radius, int edges) { return 0.5 * edges * radius * radius * std::sin(2 * pi / edges); }

TEST_F(Operations, Primitives) {
  EXPECT_DOUBLE_EQ(size_of(cube(2, 3, 4)), 24);
  EXPECT_NEAR(size_of(node(Cylinder{5, 2, 2, true, {7}})), 5 * polygon_area(2, 7), 1e-12);
  EXPECT_NEAR(size_of(node(Cylinder{5, 2, 0, false, {7}})), 5 * polygon_area(2, 7) / 3, 1e-12);
  EXPECT_NEAR(size_of(node(Cylinder{5, 0, 2, false, {7}})), 5 * polygon_area(2, 7) / 3, 1e-12);
  const double a = polygon_area(1, 9);
  EXPECT_NEAR(size_of(node(Cylinder{3, 1, 2, false, {9}})), 3 * (a + 4 * a + 2 * a) / 3, 1e-12);
  EXPECT_NEAR(size_of(circle(3, 5)), polygon_area(3, 5), 1e-8);
  EXPECT_NEAR(size_of(square(3, 5)), 15, 1e-8);
  for (const TreePtr& empty :
       {cube(0), cube(-1), sphere(0), node(Cylinder{-1, 1, 1, false, {}}), node(Cylinder{1, -1, 2, false, {}}),
        circle(-1), square(0, 1), node(Polyhedron{}), node(Polygon{})})
    EXPECT_TRUE(evaluated(empty).empty());
}

// The foot lies below the least of the given heights, and missing ones are 0, as in OpenSCAD 2021.01.
TEST_F(Operations, MissingHeightsDoNotLowerTheFoot) {
  const std::string path = ::testing::TempDir() + "missing_heights.dat";
  std::ofstream(path) << "9 6 7\n6 8\n5 3 2\n";
  const Pieces pieces = evaluated(node(Surface{path, false, false}));
  EXPECT_NEAR(volume_of(pieces[0].solid()->mesh()), 21.25, 1e-9);
  EXPECT_EQ(bounds_of(pieces[0].solid()->mesh()).lo.z, 0);
}

TEST_F(Operations, FragmentsOfCircles) {
  const auto points = [](double radius, Fragments fragments) {
    return evaluated(node(Circle{radius, fragments}))[0].region()->rings[0].size();
  };
  EXPECT_EQ(points(1, {}), 5U);     // the minimum
  EXPECT_EQ(points(3, {}), 10U);    // 2 pi 3 / 2 = 9.4
  EXPECT_EQ(points(100, {}), 30U);  // 360 / 12
  EXPECT_EQ(points(100, {1}), 3U);
  EXPECT_EQ(points(100, {0, 5, 2}), 72U);
}

TEST_F(Operations, SphereHasNoPoles) {
  const Pieces pieces = evaluated(sphere(1, 5));
  const TriangleMesh& mesh = pieces[0].solid()->mesh();
  EXPECT_EQ(mesh.points.size(), 15U);
  double top = 0;
  for (const Vec3& p : mesh.points) top = std::max(top, p.z);
  EXPECT_NEAR(top, std::cos(pi / 6), 1e-15);
}

TEST_F(Operations, PolyhedraFacesAreClockwise) {
  const Polyhedron tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                               {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
  EXPECT_NEAR(size_of(node(tetrahedron)), 1.0 / 6, 1e-15);
}

// Faces that are not flat; the volumes are those of OpenSCAD 2021.01.
TEST_F(Operations, FacesThatAreNotFlat) {
  Polyhedron box{{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {0, 0, 10}, {10, 0, 12}, {10, 10, 9}, {0, 10, 14}},
                 {{0, 1, 2, 3}, {4, 5, 1, 0}, {7, 6, 5, 4}, {5, 6, 2, 1}, {6, 7, 3, 2}, {7, 4, 0, 3}}};
  EXPECT_NEAR(size_of(node(box)), 1183 + 1.0 / 3, 1e-9);
  box.faces[2] = {6, 5, 4, 7};
  EXPECT_NEAR(size_of(node(box)), 1183 + 1.0 / 3, 1e-9);
  // A wall that crosses itself when it is seen along the axis to which it is closest.
  const Polyhedron twisted{
      {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}, {-14, -4, 7}, {6, -18, 6}, {8, 8, 7}, {-13, 11, 8}},
      {{0, 1, 2, 3}, {7, 6, 5, 4}, {4, 5, 1, 0}, {5, 6, 2, 1}, {6, 7, 3, 2}, {7, 4, 0, 3}}};
  EXPECT_NEAR(size_of(node(twisted)), 2710 + 1.0 / 3, 1e-9);
  Polyhedron star{{}, {{0, 1, 2, 3, 4, 5}, {11, 10, 9, 8, 7, 6}}};
  for (const double z : {0.0, 10.0})
    for (int n = 0; n < 6; ++n) {
      const double radius = z > 0 && n % 2 == 1 ? 4 : 10, angle = n * pi / 3;
      star.points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  for (size_t n = 0; n < 6; ++n) star.faces.push_back({6 + n, 6 + (n + 1) % 6, (n + 1) % 6, n});
  EXPECT_NEAR(size_of(node(star)), 1645.4475, 1e-3);
  // The two angles beside one diagonal are 180.4 degrees together: almost Delaunay's choice, and it stays.
  const Polyhedron prism{{{78.1831, 62.349, 10},
                          {97.4928, -22.2521, -5},
                          {-97.4928, -22.2521, 5},
                          {-78.1831, 62.349, -10},
                          {78.1831, 62.349, 200},
                          {97.4928, -22.2521, 200},
                          {-97.4928, -22.2521, 200},
                          {-78.1831, 62.349, 200}},
                         {{0, 1, 4},
                          {1, 2, 5},
                          {2, 3, 6},
                          {3, 0, 7},
                          {5, 4, 1},
                          {6, 5, 2},
                          {7, 6, 3},
                          {4, 7, 0},
                          {4, 5, 6},
                          {4, 6, 7},
                          {3, 2, 1, 0}}};
  EXPECT_NEAR(size_of(node(prism)), 3010992.164, 1);
}

TEST_F(Operations, WrongPolyhedra) {
  const auto message = [](Polyhedron polyhedron) {
    Diagnostics messages;
    const Pieces pieces = evaluate(node(std::move(polyhedron)), {}, messages);
    EXPECT_TRUE(pieces.empty() || messages.list().size() == 1);
    return messages.list().empty() ? "" : messages.list()[0].message;
  };
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_EQ(message({points, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}}}),
            "the surface of the polyhedron lacks a face, filled as flat as their edges allow");
  EXPECT_EQ(
      message({points, {{0, 1, 2}, {0, 3, 1}, {0, 3, 1}}}),
      "the polyhedron is open; it stays as it is, and cannot be combined with others: close its surface, and turn "
      "all faces so that they are clockwise when seen from outside");
  EXPECT_EQ(message({points, {{2, 1, 0}, {1, 3, 0}, {3, 2, 0}, {2, 3, 1}}}),
            "the polyhedron is inside out, in part or as a whole; it was turned");
  EXPECT_EQ(message({points, {{0, 1, 2, 9}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}}),
            "Point index 9 is out of bounds (from faces[0][3])");
  EXPECT_EQ(message({points, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}, 1, WrongPoints{"no point", ""}}),
            "no point");
}

// A prism with a base that crosses itself, 2 mm high.
TreePtr crossing_prism(const std::vector<Vec2>& base) {
  const size_t n = base.size();
  Polyhedron prism;
  for (const double z : {0.0, 2.0})
    for (const Vec2& p : base) prism.points.push_back({p.x, p.y, z});
  prism.faces.resize(2);
  for (size_t k = 0; k < n; ++k) {
    prism.faces[0].push_back(k);
    prism.faces[1].push_back(2 * n - 1 - k);
    prism.faces.push_back({k, n + k, n + (k + 1) % n, (k + 1) % n});
  }
  return node(std::move(prism));
}

TEST_F(Operations, SurfacesThatCrossThemselvesAreCombinedByWinding) {
  std::vector<Vec2> star;
  for (int n = 0; n < 5; ++n) star.push_back({std::cos(0.8 * pi * n), std::sin(0.8 * pi * n)});
  // A pentagram has ten triangles between its centre, a tip and an inner corner.
  const double inner = std::cos(0.4 * pi) / std::cos(0.2 * pi), area = 5 * inner * std::sin(0.2 * pi);
  const TreePtr upper = moved(-5, -5, 1, {cube(10)}), half_and_more = moved(-5, -5, 1, {cube(10, 10, 3)});
  Diagnostics messages;
  const auto size = [&](const TreePtr& tree) {
    double sum = 0;
    for (const Piece& piece : evaluate(tree, {}, messages)) sum += size_of(piece);
    return sum;
  };
  EXPECT_NEAR(size(difference({crossing_prism(star), upper})), area, 1e-12);
  ASSERT_EQ(messages.list().size(), 1U);
  EXPECT_EQ(messages.list()[0].message,
            "the polyhedron crosses itself; it stays as it is, and where it is combined with others, a point is inside "
            "if the surface winds around it");
  EXPECT_NEAR(size(intersection({crossing_prism(star), upper})), area, 1e-12);
  EXPECT_NEAR(size(unite({crossing_prism(star), half_and_more})), 300 + area, 1e-9);
  // The lobes of a bow tie have opposite directions.
  const TreePtr bow = crossing_prism({{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  EXPECT_NEAR(size(difference({bow, upper})), 2, 1e-12);
  EXPECT_NEAR(size(turned({0, 0, 1}, 30, {difference({turned({0, 0, 1}, -30, {bow}), upper})})), 2, 1e-9);
}

TEST_F(Operations, MissingFacesAreFilled) {
  const std::vector<Vec3> corners{{0, 0, 0},  {10, 0, 0},  {10, 10, 0},  {0, 10, 0},
                                  {0, 0, 10}, {10, 0, 10}, {10, 10, 10}, {0, 10, 10}};
  const std::vector<std::vector<size_t>> faces{{0, 1, 2, 3}, {4, 5, 1, 0}, {7, 6, 5, 4},
                                               {5, 6, 2, 1}, {6, 7, 3, 2}, {7, 4, 0, 3}};
  constexpr std::array<size_t, 6> opposite{2, 4, 0, 5, 1, 3};
  for (size_t first = 0; first < faces.size(); ++first)
    for (const size_t second : {first, opposite[first]}) {
      Polyhedron box{corners, {}};
      for (size_t n = 0; n < faces.size(); ++n)
        if (n != first && n != second) box.faces.push_back(faces[n]);
      EXPECT_NEAR(size_of(node(box)), 1000, 1e-9) << first << ' ' << second;
    }
}

TEST_F(Operations, CornersThatDifferByRoundingAreJoined) {
  // Each face of a cube has corners of its own, which differ by up to `noise`.
  for (const double noise : {0.0, 1e-12, 1e-9, 1e-7}) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> off(-noise, noise);
    Polyhedron own;
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {0.0, 10.0}) {
        std::vector<size_t>& face = own.faces.emplace_back();
        for (const Vec2 corner : {Vec2{0, 0}, Vec2{0, 10}, Vec2{10, 10}, Vec2{10, 0}}) {
          Vec3 p;
          p[axis] = side + off(random);
          p[(axis + 1) % 3] = corner.x + off(random);
          p[(axis + 2) % 3] = corner.y + off(random);
          face.push_back(own.points.size());
          own.points.push_back(p);
        }
        if (side == 0) std::reverse(face.begin(), face.end());
      }
    EXPECT_NEAR(size_of(node(own)), 1000, 1e-4) << noise;
    EXPECT_NEAR(size_of(difference({node(own), moved(5, 0, 0, {cube(10)})})), 500, 1e-4) << noise;
  }
}

TEST_F(Operations, PolygonsAreEvenOdd) {
  const std::vector<Vec2> points{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {5, 5}, {15, 5}, {15, 15}, {5, 15}};
  EXPECT_NEAR(size_of(node(Polygon{points, {{0, 1, 2, 3}, {4, 5, 6, 7}}})), 150, 1e-8);
  EXPECT_NEAR(size_of(node(Polygon{{{0, 0}, {10, 10}, {10, 0}, {0, 10}}, {}})), 50, 1e-8);
}

TEST_F(Operations, BooleansOfTouchingCubes) {
  EXPECT_DOUBLE_EQ(size_of(unite({cube(1), moved(1, 0, 0, {cube(1)})})), 2);  // they share a face
  EXPECT_DOUBLE_EQ(size_of(unite({cube(1), moved(1, 1, 0, {cube(1)})})), 2);  // they share an edge
  EXPECT_DOUBLE_EQ(size_of(unite({cube(1), moved(1, 1, 1, {cube(1)})})), 2);  // they share a corner
  EXPECT_DOUBLE_EQ(size_of(unite({cube(1), cube(1)})), 1);
  EXPECT_DOUBLE_EQ(size_of(difference({cube(2), cube(1)})), 7);
  EXPECT_DOUBLE_EQ(size_of(difference({cube(1), cube(2)})), 0);
  EXPECT_DOUBLE_EQ(size_of(intersection({cube(1), moved(1, 0, 0, {cube(1)})})), 0);
  // with a cavity
  EXPECT_DOUBLE_EQ(size_of(difference({node(Cube{{3, 3, 3}, true}), node(Cube{{1, 1, 1}, true})})), 26);
  EXPECT_DOUBLE_EQ(size_of(difference({cube(3, 3, 1), moved(1, 1, 0, {cube(1)})})), 8);  // with a hole
}

// A checkerboard of cutters that are flush with the outside: what is left touches itself along edges.
TEST_F(Operations, CuttersThatMeetInEdgesEnd) {
  EXPECT_DOUBLE_EQ(size_of(difference({cube(10), cube(5, 5, 10), moved(5, 5, 0, {cube(5, 5, 10)})})), 500);
  Children board{cube(3, 3, 1)};
  for (int n = 0; n < 9; n += 2) board.push_back(moved(n % 3, n / 3, 0, {cube(1)}));
  EXPECT_DOUBLE_EQ(size_of(difference(board)), 4);
  board[0] = nothing();
  EXPECT_DOUBLE_EQ(size_of(unite(board)), 5);
  EXPECT_DOUBLE_EQ(size_of(difference({unite(board), cube(1.5, 3, 1)})), 2 + 0.5);
  EXPECT_DOUBLE_EQ(size_of(difference({cube(2), cube(1), moved(1, 1, 0, {cube(1)}), moved(0, 1, 1, {cube(1)}),
                                       moved(1, 0, 1, {cube(1)})})),
                   4);
}

// A square of 2 mm is 2 (1 - s) mm wide at a height of share s; the slot takes half of that along half of the ridge.
TEST_F(Operations, RoofsEndInARidge) {
  const auto roof = [](Vec2 scale, const TreePtr& region) {
    LinearExtrude by;
    by.height = 3;
    by.scale = scale;
    return node(by, {region});
  };
  const TreePtr square2 = moved(-1, -1, 0, {square(2, 2)});
  const TreePtr slotted = difference({square2, moved(-1, -0.5, 0, {square(1, 1)})});
  for (const Vec2 scale : {Vec2{0, 1}, Vec2{1, 0}}) {
    EXPECT_NEAR(size_of(roof(scale, square2)), 6, 1e-9);
    EXPECT_NEAR(size_of(roof(scale, slotted)), 4.5, 1e-9);
  }
  EXPECT_NEAR(size_of(roof({0, 2}, square2)), 2 * 3 * (1 + 1.0 / 3), 1e-9);
}

TEST_F(Operations, WhatTouchesItselfGoesOn) {
  const TreePtr touching = unite({cube(1), moved(1, 1, 0, {cube(1)})});
  EXPECT_DOUBLE_EQ(size_of(difference({touching, moved(0.5, 0.5, 0, {cube(1)})})), 1.5);
  EXPECT_DOUBLE_EQ(size_of(unite({touching, moved(0.5, 0.5, 0, {cube(1)})})), 2.5);
}

// Boxes have integer coordinates, so that counting cells gives the volume.
TEST_F(Operations, RandomTreesOfBoxes) {
  constexpr int size = 6;
  using Cells = std::array<bool, size * size * size>;
  std::mt19937 random(7);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto box = [&](Cells& cells) {
    std::array<int, 3> lo{}, hi{};
    for (size_t axis = 0; axis < 3; ++axis) {
      lo[axis] = below(size - 1);
      hi[axis] = lo[axis] + 1 + below(size - lo[axis]);
    }
    for (int n = 0; n < size * size * size; ++n) {
      const std::array<int, 3> p{n % size, n / size % size, n / size / size};
      cells[static_cast<size_t>(n)] =
          p[0] >= lo[0] && p[0] < hi[0] && p[1] >= lo[1] && p[1] < hi[1] && p[2] >= lo[2] && p[2] < hi[2];
    }
    return moved(lo[0], lo[1], lo[2], {cube(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2])});
  };
  for (int round = 0; round < 12; ++round) {
    Cells cells{};
    TreePtr tree = box(cells);
    for (int n = 0; n < 5; ++n) {
      Cells other{};
      const TreePtr next = box(other);
      const int kind = below(3);
      tree = kind == 0 ? unite({tree, next}) : kind == 1 ? difference({tree, next}) : unite({next, tree});
      for (size_t k = 0; k < cells.size(); ++k) cells[k] = kind == 1 ? cells[k] && !other[k] : cells[k] || other[k];
    }
    EXPECT_NEAR(size_of(tree), static_cast<double>(std::count(cells.begin(), cells.end(), true)), 1e-9) << round;
  }
}

TEST_F(Operations, RotatedBoxesMeetExactly) {
  const TreePtr two = unite({cube(1), moved(1, 0, 0, {cube(1)})});
  EXPECT_NEAR(size_of(turned({1, 2, 3}, 37, {two})), 2, 1e-12);
  EXPECT_NEAR(size_of(unite({turned({1, 2, 3}, 37, {two}), turned({1, 2, 3}, 37, {cube(1, 2, 1)})})), 3, 1e-9);
}

TEST_F(Operations, MirroredSolidsStayOutward) {
  const TreePtr tree = node(Transform{Affine::scaling({-1, 1, 1})}, {difference({cube(2), cube(1)})});
  EXPECT_DOUBLE_EQ(size_of(tree), 7);
  EXPECT_DOUBLE_EQ(size_of(node(Transform{Affine::scaling({-1, 1, 1})}, {cube(2)})), 8);
}

// Three solids have a common corner, and two of them overlap: 8 + 1 plus the part outside of the greater block. The
// prism of 1 x 1 x 1 is turned about z by 30 degrees, so a triangle with legs 1 and tan 30 is outside.
TEST_F(Operations, SolidsThatMeetInACornerAreUnited) {
  Transform turn;
  turn.parent_from_child = Affine::rotation({0, 0, 1}, 30);
  const TreePtr prism = node(turn, {cube(1)}), below = moved(-1, -1, -1, {cube(1)});
  const double outside = 0.5 * std::tan(pi / 6);
  for (const auto& children :
       {Children{prism, below, cube(2)}, Children{cube(2), below, prism}, Children{below, cube(2), prism}}) {
    double volume = 0;
    for (const Piece& piece : evaluated(node(Union{}, children))) volume += size_of(piece);
    EXPECT_NEAR(volume, 9 + outside, 1e-9);
  }
}

// The faces of balls have four corners, which rounding moves out of their plane.
TEST_F(Operations, BallsAreConvexWhateverTheirCornersRoundTo) {
  for (const double edges : {5, 16, 30, 40, 100})
    for (const double away : {0.0, 1e3}) {
      const Pieces ball = evaluated(moved(away, away / 3, 0, {node(Sphere{2, {edges}})}));
      EXPECT_TRUE(kernel().is_convex(*ball.at(0).solid()->body())) << edges << " edges, moved by " << away;
    }
  const Pieces dented = evaluated(difference({cube(10), moved(5, 5, 10 - 1e-6, {cube(1)})}));
  EXPECT_FALSE(kernel().is_convex(*dented.at(0).solid()->body()));
}

TEST_F(Operations, HullAndMinkowski) {
  EXPECT_NEAR(size_of(hull({cube(1), moved(2, 0, 0, {cube(1)})})), 3, 1e-12);
  EXPECT_NEAR(size_of(hull({square(1, 1), node(Transform{Affine::translation({2, 0, 0})}, {square(1, 1)})})), 3, 1e-8);
  EXPECT_NEAR(size_of(minkowski({cube(10), node(Cube{{2, 2, 2}, true})})), 12 * 12 * 12, 1e-9);
  // Steiner's formula for a convex region: area + perimeter * r + area of the rounding polygon.
  EXPECT_NEAR(size_of(minkowski({square(10, 10), circle(1, 8)})), 100 + 40 + polygon_area(1, 8), 1e-7);
  const TreePtr frame = difference({square(10, 10), moved(3, 3, 0, {square(4, 4)})});
  EXPECT_NEAR(size_of(minkowski({frame, circle(1, 8)})), 142.8284271 - 4, 1e-6);
  // The other summand is thick enough to close the frame's hole.
  EXPECT_NEAR(size_of(minkowski({frame, square(5, 5)})), 225, 1e-7);
  const TreePtr corner = difference({cube(4), moved(1, 1, -1, {cube(9)})});
  EXPECT_NEAR(size_of(minkowski({corner, cube(1)})), 5 * (25 - 9), 1e-9);
}

TEST_F(Operations, OffsetsAsOpenScadCutsCorners) {
  const auto by = [](double distance, bool round, bool chamfer, double edges) {
    return size_of(node(Offset{distance, round, chamfer, {edges}}, {square(10, 10)}));
  };
  EXPECT_NEAR(by(2, false, false, 0), 196, 1e-6);
  EXPECT_SIZE(by(2, true, false, 0), 191.24268);
  EXPECT_SIZE(by(2, true, false, 20), 192.360577);
  EXPECT_SIZE(by(2, false, true, 0), 193.254777);
  EXPECT_NEAR(by(-2, false, false, 0), 36, 1e-6);
  EXPECT_NEAR(by(-9, false, false, 0), 0, 1e-6);
  const TreePtr frame = difference({square(20, 20), moved(5, 5, 0, {square(10, 10)})});
  EXPECT_SIZE(size_of(node(Offset{-2, true, false, {}}, {frame})), 64.75732);
  EXPECT_NEAR(size_of(node(Fill{}, {frame})), 400, 1e-6);
}

// An index out of bounds is left out of a path.
TEST_F(Operations, WrongPaths) {
  Diagnostics messages;
  const Pieces pieces = evaluate(node(Polygon{{{0, 0}, {10, 0}, {10, 10}}, {{0, 1, 2, 7}}}), {}, messages);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_NEAR(area_of(*pieces[0].region()), 50, 1e-9);
  ASSERT_EQ(messages.list().size(), 1U);
  EXPECT_EQ(messages.list()[0].message, "Point index 7 is out of bounds (from paths[0][3])");
}

TEST_F(Operations, Projections) {
  EXPECT_SIZE(size_of(node(Projection{}, {sphere(5, 10)})), 73.472888);
  EXPECT_SIZE(size_of(node(Projection{true}, {moved(0, 0, 1, {sphere(5, 10)})})), 64.234282);
  EXPECT_NEAR(size_of(node(Projection{true}, {cube(5)})), 25, 1e-6);                     // its bottom lies in the plane
  EXPECT_NEAR(size_of(node(Projection{true}, {moved(0, 0, -5, {cube(5)})})), 25, 1e-6);  // its top lies in the plane
  EXPECT_NEAR(size_of(node(Projection{}, {difference({cube(5), moved(1, 1, -1, {cube(1, 1, 9)})})})), 24, 1e-6);
}

TEST_F(Operations, Resizing) {
  const auto to = [](Vec3 size, std::array<bool, 3> automatic, const TreePtr& of) {
    return size_of(node(Resize{size, automatic}, {of}));
  };
  EXPECT_NEAR(to({10, 12, 0}, {true, true, true}, cube(1, 2, 3)), 2160, 1e-9);
  EXPECT_NEAR(to({10, 0, 0}, {false, true, false}, cube(1, 2, 3)), 600, 1e-9);
  EXPECT_NEAR(to({0, 0, 5}, {true, true, true}, cube(1, 2, 3)), 27.7777778, 1e-6);
  EXPECT_NEAR(to({10, 0, 0}, {}, circle(1, 8)), 14.1421356, 1e-6);
  EXPECT_NEAR(to({10, 0, 0}, {true, true, true}, circle(1, 8)), 70.7106781, 1e-6);
}

TEST_F(Operations, DimensionsAreNotMixed) {
  const auto messages_of = [](const TreePtr& tree, double size) {
    Diagnostics messages;
    double sum = 0;
    for (const Piece& piece : evaluate(tree, {}, messages)) sum += size_of(piece);
    EXPECT_NEAR(sum, size, 1e-6);
    std::string text;
    for (const Diagnostic& message : messages.list()) text += message.message + "\n";
    return text;
  };
  EXPECT_EQ(messages_of(group({cube(1), square(3, 3)}), 1),
            "Mixing 2D and 3D objects is not supported\nIgnoring 2D child object for 3D operation\n");
  EXPECT_EQ(messages_of(group({square(3, 3), cube(1)}), 9),
            "Mixing 2D and 3D objects is not supported\nIgnoring 3D child object for 2D operation\n");
  EXPECT_EQ(messages_of(node(LinearExtrude{}, {cube(1)}), 0), "Ignoring 3D child object for 2D operation\n");
  EXPECT_EQ(messages_of(node(Projection{}, {square(3, 3)}), 0), "");
}

TEST_F(Operations, BackgroundIsLeftOut) {
  auto background = std::make_shared<Tree>(*cube(9));
  background->background = true;
  EXPECT_DOUBLE_EQ(size_of(difference({background, cube(2), cube(1)})), 7);
}

TEST_F(Operations, DeepTreesNeedNoStack) {
  TreePtr tree = cube(1);
  for (int n = 0; n < 20'000; ++n) tree = moved(1, 0, 0, {tree});
  EXPECT_DOUBLE_EQ(size_of(tree), 1);
  while (tree) {  // frees it iteratively, as its destructor would recursively
    TreePtr child = tree->children.empty() ? nullptr : tree->children[0];
    tree = std::move(child);
  }
}

TEST_F(Operations, StopsOnRequest) {
  StopFlag stop;
  stop.request();
  EvaluateOptions options;
  options.stop = &stop;
  Diagnostics messages;
  EXPECT_THROW(evaluate(unite({cube(1), sphere(1)}), options, messages), Cancelled);
}

}  // namespace
}  // namespace ombre::solids
