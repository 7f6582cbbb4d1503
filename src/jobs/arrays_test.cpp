// Tests arrays of copies against unions of the same copies written out.
#include "jobs/slice/plan.h"
#include "jobs/test_job_solids.h"

namespace ombre::compile {
namespace {

// The children: one beside its origin, one that is not a ball in its box, and one with overlapping parts and an
// attribute.
const char* const children[] = {
    "translate(0.3, 0.1, 0) sphere(0.9, \"red\");",
    "rotate(20, 40, 10) rectprism((2.5, 0.6, 0.4), \"red\");",
    "union(materials=\"first\") { fgrade([\"0.5 + x/9\", \"0.5 - x/9\"], [\"red\", \"blue\"]) strut((-2, -1, -0.4), "
    "(1.8, 1, "
    "0.5), 0.3); attribute(\"infill\", \"1 + y/5\", \"1\") translate(1, 0, 0) cube(1, \"cyan\"); }",
};

struct Pair {
  std::string array, written_out;  // code before the child
  Vec3 first, last;                // the copies' places span the box between these
};

std::string options(const std::string& materials) { return "materials=\"" + materials + "\""; }

std::vector<Pair> pairs(const std::string& materials) {
  const std::string rule = options(materials), all = "union(" + rule + ") ";
  return {
      {"array_linear(30, (3, 1, -0.5), " + rule + ") ",
       all + "for (i = [0 : 29]) translate(3*i, i, -0.5*i) ",
       {0, 0, 0},
       {87, 29, -14.5}},
      // The copies overlap and go backwards.
      {"array_linear(40, (-0.7, 0, 0), " + rule + ") ",
       all + "for (i = [0 : 39]) translate(-0.7*i, 0, 0) ",
       {-27.3, 0, 0},
       {0, 0, 0}},
      {"array_grid((6, 5, 4), (4, -3, 5), " + rule + ") ",
       all + "for (k = [0 : 3]) for (j = [0 : 4]) for (i = [0 : 5]) translate(4*i, -3*j, 5*k) ",
       {0, -12, 0},
       {20, 0, 15}},
      {"array_grid((9, 1, 2), (2, 0, 3), centred=true, " + rule + ") ",
       all + "for (k = [0 : 1]) for (i = [0 : 8]) translate(2*i - 8, 0, 3*k - 1.5) ",
       {-8, 0, -1.5},
       {8, 0, 1.5}},
      {"array_polar(20, radius=12, " + rule + ") ",
       all + "for (i = [0 : 19]) rotate(axis=z, deg=18*i) translate(12, 0, 0) ",
       {-12, -12, 0},
       {12, 12, 0}},
      // The copies overlap, all round and not.
      {"array_polar(40, (1, 1, 0), radius=6, around=(1, 2, 3), " + rule + ") ",
       all +
           "for (i = [0 : 39]) rotate(axis=(1, 1, 0), deg=9*i, around=(1, 2, 3)) translate(6/sqrt(2), -6/sqrt(2), 0) ",
       {-5, -4, -3},
       {7, 8, 9}},
      {"translate(1, 0, 0) array_polar(12, angle=-120, " + rule + ") translate(0, 7, 0) ",
       all + "for (i = [0 : 11]) translate(1, 0, 0) rotate(axis=z, deg=-120/11*i) translate(0, 7, 0) ",
       {1, -3.5, 0},
       {8, 7, 0}},
      {"array_polar(3, x, radius=2, " + rule + ") ",
       all + "for (i = [0 : 2]) rotate(axis=x, deg=120*i) translate(0, 2, 0) ",
       {0, -2, -2},
       {0, 2, 2}},
      {"array_mirror((1, 2, 0), (0.5, 0, 0), " + rule + ") ",
       all + "{ original(); translate(0.5, 0, 0) mirror((1, 2, 0)) translate(-0.5, 0, 0) original(); } ",
       {0, 0, 0},
       {1, 0, 0}},
  };
}

std::string design(const std::string& before, const std::string& child) {
  return "module original() { " + child + " } " + before +
         (before.find("original") < before.size() ? "" : "original();");
}

void expect_equal(const std::string& array_text, const std::string& union_text, Vec3 first, Vec3 last) {
  SCOPED_TRACE(array_text);
  const TestSolid array(array_text), other(union_text);
  RandomPoints shares({{0, 0, 0}, {1, 1, 1}}), around(Box::centered({2.5, 2.5, 2.5}));
  size_t found = 0;
  for (int n = 0; n < 6000; ++n) {
    // Points lie anywhere and along the diagonal, on which rows lie, in turn.
    Vec3 share = shares.next();
    if (n % 2) share = {share.x, share.x, share.x};
    const Vec3 way = last - first, p = first + Vec3{share.x * way.x, share.y * way.y, share.z * way.z} + around.next();
    const auto a = array.at(p), b = other.at(p);
    if (std::abs(b.distance) < 1e-9) continue;
    ASSERT_EQ(a.inside, b.inside) << union_text << " at " << p.x << " " << p.y << " " << p.z;
    ASSERT_EQ(a.interior, b.interior);
    ASSERT_EQ(a.distance <= 0, a.inside);
    if (b.inside)
      ASSERT_NEAR(a.distance, b.distance, 1e-9);
    else
      ASSERT_LE(a.distance, b.distance + 1e-9);
    if (!b.inside) continue;
    ++found;
    ASSERT_EQ(a.fractions.size(), b.fractions.size());
    for (const auto& [name, fraction] : b.fractions) ASSERT_NEAR(a.fractions.at(name), fraction, 1e-9) << name;
    for (const auto& [name, value] : b.attributes) ASSERT_NEAR(a.attributes.at(name), value, 1e-9) << name;
  }
  EXPECT_GT(found, 4u);
}

void expect_equal(const std::string& materials) {
  for (const Pair& pair : pairs(materials))
    for (const char* child : children)
      expect_equal(design(pair.array, child), design(pair.written_out, child), pair.first, pair.last);
}

}  // namespace

TEST(Arrays, AreUnionsOfTheirCopies) { expect_equal("first"); }
TEST(Arrays, MixWhereCopiesOverlap) { expect_equal("mix"); }
TEST(Arrays, LetTheLastCopyWin) { expect_equal("last"); }

// Between the copies the distance is that to the nearest one, which can be any of them.
TEST(Arrays, AreExactBetweenTheirCopies) {
  const char* const ball = "sphere(0.5, \"red\");";
  const TestSolid array(std::string("array_grid((50, 40, 30), (7, 9, 5)) ") + ball);
  RandomPoints points({{0, 0, 0}, {7 * 49, 9 * 39, 5 * 29}});
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p = points.next();
    const auto off = [](double v, double step) { return v - step * std::round(v / step); };
    EXPECT_NEAR(array.at(p).distance, length({off(p.x, 7), off(p.y, 9), off(p.z, 5)}) - 0.5, 1e-9);
  }
}

TEST(Arrays, FarAwayDistancesAreBounds) {
  const TestSolid row("array_linear(50, (2, 2, 0)) sphere(0.5, \"red\");");
  RandomPoints points({{-60, -60, -60}, {160, 160, 60}});
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p = points.next();
    double least = 1e9;
    for (int i = 0; i < 50; ++i) least = std::min(least, length(p - Vec3{2.0 * i, 2.0 * i, 0}) - 0.5);
    const double found = row.at(p).distance;
    EXPECT_LE(found, least + 1e-9);
    EXPECT_GE(found, std::min(least, 1.0));
  }
}

TEST(Arrays, AskNoMoreWhereThereAreMoreCopies) {
  for (const std::string child : {"sphere(1.4, \"red\");", "cube(4, \"red\");"}) {
    // Programs may differ by this many constants, since some numbers are no longer equal.
    constexpr size_t constants = 4;
    const auto size = [&](const std::string& array) { return TestSolid(array + child).inside_size(); };
    EXPECT_LE(size("array_linear(9000, (3, 0, 0)) "), size("array_linear(50, (3, 0, 0)) ") + constants);
    EXPECT_LE(size("array_grid((1000, 500, 700), (3, 3, 3)) "),
              size("array_grid((20, 20, 20), (3, 3, 3)) ") + constants);
    EXPECT_LE(size("array_polar(31, radius=20) "), size("array_polar(30, radius=20) ") + constants);
  }
}

// The copies that copies of copies would ask are counted before they are written out.
TEST(Arrays, SayWhenCopiesOfCopiesAreTooMany) {
  Diagnostics diagnostics;
  std::string text = "cube(1, \"red\");";
  for (int n = 0; n < 60; ++n) text = "array_mirror((1, 1, 0)) translate(1, 0, 0) " + text;
  const LoadedPtr loaded = load_text(text, diagnostics);
  ASSERT_TRUE(loaded) << to_text(diagnostics);
  EXPECT_FALSE(plan_slice(loaded, {}, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("the design repeats its parts too often"), std::string::npos);
}

// A union of this many solids becomes a table; arrays that repeat little go into it.
TEST(Arrays, GoIntoUnionsOfManySolids) {
  std::string arrays, written_out;
  for (int n = 0; n < 40; ++n) {
    const std::string move = "translate(0, " + std::to_string(2 * n) + ", 0) ", ball = "sphere(0.8, \"red\");";
    const std::string count = std::to_string(5 + n);
    arrays += move + "array_grid((" + count + ", 2, 1), (2, 0.9, 1)) " + ball;
    written_out += "for (j = [0, 1]) for (i = [1 : " + count + "]) translate(2*i - 2, 0.9*j, 0) " + move + ball;
  }
  const TestSolid table("union() {" + arrays + "}"), other("union() {" + written_out + "}");
  RandomPoints points({{-1, -1, -1}, {90, 82, 1}});
  for (int n = 0; n < 3000; ++n) {
    const Vec3 p = points.next();
    EXPECT_EQ(table.at(p).inside, other.at(p).inside) << p.x << " " << p.y << " " << p.z;
  }
}

// The composition is defined everywhere, also outside: it is that of the nearest copy.
TEST(Arrays, GiveTheCompositionOfTheNearestCopyOutside) {
  const TestSolid row("array_linear(30, (4, 0, 0)) fgrade([\"1 + x\", \"1 - x\"], [\"red\", \"blue\"]) sphere(1);",
                      design::Demand::everywhere);
  for (int i = 0; i < 30; ++i) {
    const auto answer = row.at({4.0 * i + 0.5, 2, 0});
    EXPECT_FALSE(answer.inside);
    EXPECT_NEAR(answer.fractions.at("red"), 0.75, 1e-12);
  }
}

TEST(Arrays, HaveBoundsOfTheirCopies) {
  const auto bounds = [](const std::string& text) { return TestSolid(text).node().bounds(design::design_space()); };
  const auto expect_box = [&](const std::string& text, Vec3 lo, Vec3 hi) {
    const Box box = bounds(text);
    EXPECT_LT(length(box.lo - lo) + length(box.hi - hi), 1e-6) << text;
  };
  expect_box("array_linear(5, (3, 1, 0)) sphere(1, \"red\");", {-1, -1, -1}, {13, 5, 1});
  expect_box("array_grid((3, 2, 1), (-5, 4, 9)) cube(2, \"red\");", {-11, -1, -1}, {1, 5, 1});
  expect_box("array_grid((3, 2, 1), (5, 4, 9), centred=true) cube(2, \"red\");", {-6, -3, -1}, {6, 3, 1});
  expect_box("array_polar(4, radius=6) cube(2, \"red\");", {-7, -7, -1}, {7, 7, 1});
  expect_box("array_mirror(x, (1, 0, 0)) translate(4, 0, 0) cube(2, \"red\");", {-3, -1, -1}, {5, 1, 1});
  // Only the copies that meet a box count for the bounds within it.
  const Box part = TestSolid("array_linear(9, (10, 0, 0)) cube(2, \"red\");").node().bounds({{12, -5, -5}, {38, 5, 5}});
  EXPECT_NEAR(part.lo.x, 19, 1e-6);
  EXPECT_NEAR(part.hi.x, 31, 1e-6);
}

}  // namespace ombre::compile
