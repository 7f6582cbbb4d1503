// Tests that unions of many parts, which are tables, have the voxels of the same parts written out.
#include <algorithm>
#include <random>
#include <span>

#include "base/system/test_source_files.h"
#include "jobs/slice/plan.h"
#include "jobs/test_designs.h"
#include "program/parts.h"
#include "questions/build.h"

namespace ombre::compile {
namespace {

// Returns struts and balls of several materials, some graded, that overlap.
std::vector<std::string> some_parts(int count) {
  std::mt19937 random(5);
  const auto number = [&](double lo, double hi) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", std::uniform_real_distribution<double>(lo, hi)(random));
    return std::string(text);
  };
  const auto point = [&](double reach) {
    return "(" + number(-reach, reach) + ", " + number(-reach, reach) + ", " + number(-reach, reach) + ")";
  };
  std::vector<std::string> parts;
  for (int n = 0; n < count; ++n) {
    const std::string material = n % 3 == 0 ? "\"red\"" : n % 3 == 1 ? "\"blue\"" : "\"cyan\"";
    switch (random() % 4) {
      case 0:
        parts.push_back("strut(" + point(3) + ", " + point(3) + ", 0.3, " + material + ");");
        break;
      case 1:
        parts.push_back("translate" + point(3) + " rotate(" + number(0, 90) + ", 20, 0) rectprism((0.6, 1.5, 0.4), " +
                        material + ");");
        break;
      case 2:
        parts.push_back("fgrade([\"0.5 + " + number(0.02, 0.1) + "*x\", \"0.4\"], [\"red\", \"cyan\"]) strut(" +
                        point(3) + ", " + point(3) + ", 0.25);");
        break;
      default:
        parts.push_back("translate" + point(3) + " sphere(" + number(0.2, 0.7) + ", " + material + ");");
    }
  }
  return parts;
}

constexpr const char* box = "root((-4, -4, -4), (4, 4, 4), (0.05, 0.06, 0.07)) ";

std::string flat(const std::vector<std::string>& parts, const std::string& options = "") {
  std::string text = "union(" + options + ") {";
  for (const std::string& part : parts) text += part + "\n";
  return text + "}";
}

// Joins the parts two by two, too few for tables. This does not help if inputs of a union count as one.
std::string in_pairs(std::span<const std::string> parts, const std::string& options) {
  if (parts.size() == 1) return parts[0] + "\n";
  const size_t half = parts.size() / 2;
  return "union(" + options + ") {" + in_pairs(parts.first(half), options) + in_pairs(parts.subspan(half), options) +
         "}";
}

size_t differences(const Voxels& a, const Voxels& b) {
  EXPECT_EQ(a.ids.size(), b.ids.size());
  size_t count = 0;
  for (size_t n = 0; n < std::min(a.ids.size(), b.ids.size()); ++n) count += a.ids[n] != b.ids[n];
  return count;
}

Voxels slice_as(const std::string& body, voxel::EvaluatorOptions options, const std::string& where = box) {
  PlanOptions plan;
  plan.evaluator = options.evaluator;
  plan.speed = options;
  return slice_text(where + "{" + body + "}", plan, 5);
}

void expect_one_result(const std::string& body) {
  const Voxels batch = slice_as(body, {});
  EXPECT_GT(batch.volume(), 1) << body;
  voxel::EvaluatorOptions written_out;
  written_out.write_parts_out = true;
  EXPECT_EQ(differences(batch, slice_as(body, written_out)), 0u) << body;
  voxel::EvaluatorOptions narrow;
  narrow.leaf_width = 32;
  EXPECT_EQ(differences(batch, slice_as(body, narrow)), 0u) << body;
  voxel::EvaluatorOptions reference;
  reference.evaluator = voxel::Evaluator::reference;
  EXPECT_LT(differences(batch, slice_as(body, reference)), batch.ids.size() / 100'000) << body;
}

// Returns the number of parts in each table of a design.
std::vector<size_t> tables_of(const std::string& body, const std::string& where = box) {
  Diagnostics diagnostics;
  const auto built = build_flat_program(load_text(where + "{" + body + "}", diagnostics)->design, diagnostics);
  EXPECT_TRUE(built) << to_text(diagnostics);
  std::vector<size_t> sizes;
  std::vector<const program::PartSet*> seen;
  for (const auto& set : built->materials.program.part_sets) {
    if (std::ranges::find(seen, set.get()) != seen.end()) continue;
    seen.push_back(set.get());
    sizes.push_back(set->batch.size());
  }
  return sizes;
}

}  // namespace

TEST(ManyParts, AreATableWhereItPays) {
  const std::string struts =
      "strut((-3, -3, -3), (3, 2, 3), 0.12, \"red\"); strut((-3, 3, -3), (2, -3, 1), 0.12, \"blue\");";
  const std::string third = "strut((3, 3, -3), (2, -2, 3), 0.12, \"red\");";
  EXPECT_EQ(tables_of("union() {" + struts + third + "}"), std::vector<size_t>{3});
  EXPECT_EQ(tables_of("union() {" + struts + "}"), std::vector<size_t>{});
  // Parts that lie close together become a table only if there are dozens.
  EXPECT_EQ(tables_of(flat(std::vector<std::string>(31, "sphere(3, \"red\");"))), std::vector<size_t>{});
  EXPECT_EQ(tables_of(flat(std::vector<std::string>(32, "sphere(3, \"red\");"))), std::vector<size_t>{32});
  // The parts have long programs.
  const std::string hull = "hull([for (n = [0:99]) let (p = rands(-1, 1, 3, n)) p / norm(p) * 0.5]);";
  EXPECT_EQ(tables_of("union() {" + struts + "translate(3, -3, -3) " + hull + "}"), std::vector<size_t>{});
  // Lattices keep tables of their own.
  const std::string lattice =
      "lattice(edges=[for (n = [0:299]) let (p = rands(-3, -2, 6, n)) [[p[0], p[1], p[2]], [p[3], p[4], p[5]]]], "
      "radius=0.01);";
  EXPECT_EQ(tables_of("union() {" + struts + third + lattice + "}"), (std::vector<size_t>{3, 300}));
  for (const std::string options : {"", "materials=\"first\"", "materials=\"last\"", "blend=0.3"})
    expect_one_result("union(" + options + ") {" + struts + third + "}");
  expect_one_result("difference() { cube(7); union() {" + struts + third + lattice + "} }");
}

TEST(ManyParts, AreTheSameInTablesAndWrittenOut) {
  const auto parts = some_parts(200);
  expect_one_result(flat(parts));
  expect_one_result(flat(parts, "materials=\"first\""));
  expect_one_result(flat(parts, "materials=\"last\""));
}

// A value is evaluated in the frame of its part.
TEST(ManyParts, MayHaveValues) {
  const std::string part =
      " sphere(0.4 + 0.3*noise(size=0.8), mix(\"red\", mix(\"blue\", \"cyan\", 0.5), noise(size=1.1, seed=3)));";
  std::vector<std::string> parts;
  for (int n = 0; n < 36; ++n)
    parts.push_back("translate(rands(-2, 2, 3, " + std::to_string(n) + ")) rotate(0, 0, " + std::to_string(7 * n) +
                    ")" + part);
  EXPECT_EQ(tables_of(flat(parts)), std::vector<size_t>{36});
  expect_one_result(flat(parts));
  expect_one_result(flat(parts, "blend=0.2"));
}

// The parts have influence beyond their surfaces.
TEST(ManyParts, AreJoinedSmoothly) {
  const auto parts = some_parts(120);
  for (const std::string rule : {"mix", "first", "last", "blend"})
    expect_one_result(flat(parts, "blend=0.3, materials=\"" + rule + "\""));
  expect_one_result(flat(parts, "blend=0.2, join=\"chamfer\""));
  const Voxels sharp = slice_as(flat(parts), {}), smooth = slice_as(flat(parts, "blend=0.3"), {});
  EXPECT_GT(smooth.volume(), 1.05 * sharp.volume());
  std::string sum = flat(parts, "blend=0.3");
  expect_one_result(sum.replace(0, 5, "sum"));
}

TEST(ManyParts, OfALatticeAreRowsToo) {
  expect_one_result(
      "lattice(edges=[for (i=[0:99]) let (p = rands(-3, 3, 6, i)) "
      "[[p[0], p[1], p[2]], [p[3], p[4], p[5]]]], radius=\"0.1 + 0.2*t\", material=\"red\");");
  expect_one_result("intersection() { sphere(3.5, \"red\"); tile() lattice(\"diamond\", (2, 2, 2.5), 0.2); }");
  expect_one_result(
      "intersection() { sphere(3.5, \"red\"); rotate(10, 20, 30) tile() fgrade([\"abs(ci)\", \"1 + abs(ck)\"], "
      "[\"red\", \"blue\"]) lattice(\"octet\", (2, 2, 2.5), 0.2); }");
  expect_one_result(
      "intersection() { sphere(3.5, \"red\"); tile((2.5, 2, 0)) union() { cube(1, \"blue\"); "
      "translate(0.7, 0.9, 0.2) sphere(0.8, \"cyan\"); } }");
}

TEST(ManyParts, FirstAndLastDoNotDependOnGroups) {
  const auto parts = some_parts(200);
  EXPECT_EQ(tables_of(in_pairs(parts, "")), std::vector<size_t>{});
  for (const std::string rule : {"materials=\"first\"", "materials=\"last\""})
    EXPECT_EQ(differences(slice_as(flat(parts, rule), {}), slice_as(in_pairs(parts, rule), {})), 0u) << rule;
}

// A mesh stands before, after or amid the parts of the table.
TEST(ManyParts, FirstAndLastKeepTheOrderBesideMeshes) {
  const std::string mesh = "scale(0.2, 0.2, 0.4) mesh(\"" + source_file("examples/models/gear.stl") + "\", \"green\");";
  for (const size_t at : {size_t{0}, size_t{50}, size_t{70}}) {
    std::vector<std::string> parts = some_parts(70);
    parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(at), mesh);
    for (const std::string rule : {"materials=\"first\"", "materials=\"last\""})
      EXPECT_EQ(differences(slice_as(flat(parts, rule), {}), slice_as(in_pairs(parts, rule), {})), 0u) << rule << at;
  }
}

TEST(ManyParts, CanBeMovedCutAndCombined) {
  const auto parts = some_parts(60);
  const std::string many = flat(parts);
  expect_one_result("translate(0.3, 0.2, 0.1) rotate(10, 20, 30) " + many);
  expect_one_result("intersection() { sphere(3, \"red\"); " + many + "}");
  expect_one_result("difference() { sphere(3.5, \"red\"); " + many + "}");
  expect_one_result("fgrade([\"0.6\", \"0.4\"], [\"red\", \"blue\"]) " + many);
  expect_one_result("module many() {" + many + "} many(); rotate(0, 0, 90) many();");
}

TEST(ManyParts, TakeMeshesAlong) {
  auto parts = some_parts(60);
  parts.push_back("scale(0.1, 0.1, 0.1) mesh(\"" + source_file("examples/models/gear.stl") + "\");");
  expect_one_result(flat(parts));
}

// Returns more parts than go into one task: first red ones alone, then all kinds, with one that has no row and one that
// can fail.
std::vector<std::string> parts_of_several_tasks() {
  std::vector<std::string> parts;
  for (const std::string& part : some_parts(1600))
    if (part.find("red") != std::string::npos && part.find("fgrade") == std::string::npos) parts.push_back(part);
  EXPECT_GT(parts.size(), 300u);
  parts.resize(300);
  parts.push_back("scale(0.1, 0.1, 0.1) mesh(\"" + source_file("examples/models/gear.stl") + "\");");
  parts.push_back("fgrade([\"x\", \"1 - x\"], [\"magenta\", \"blue\"]) sphere(1, \"cyan\");");
  for (const std::string& part : some_parts(298)) parts.push_back(part);
  return parts;
}

constexpr const char* coarse = "root((-4, -4, -4), (4, 4, 4), (0.1, 0.12, 0.14)) ";

TEST(ManyParts, OfSeveralTasksAreOneTable) {
  const auto parts = parts_of_several_tasks();
  for (const std::string rule : {"materials=\"first\"", "materials=\"last\""})
    EXPECT_EQ(differences(slice_as(flat(parts, rule), {}, coarse), slice_as(in_pairs(parts, rule), {}, coarse)), 0u);
  voxel::EvaluatorOptions written_out;
  written_out.write_parts_out = true;
  for (const std::string options : {"", "blend=0.2"}) {
    const std::string body = flat(parts, options);
    EXPECT_EQ(differences(slice_as(body, {}, coarse), slice_as(body, written_out, coarse)), 0u) << options;
  }
}

// There are so many parts that they are also read ahead.
TEST(ManyParts, DoNotDependOnThreads) {
  const std::string text = coarse + ("{" + flat(some_parts(2600)) + "}");
  PlanOptions one, several;
  one.threads = 1;
  several.threads = 4;
  EXPECT_EQ(differences(slice_text(text, one, 5), slice_text(text, several, 5)), 0u);
}

TEST(ManyParts, TellOfFailedChecks) {
  auto parts = some_parts(60);
  parts.push_back("fgrade([\"x - 10\", \"-1\"], [\"red\", \"blue\"]) sphere(1, \"cyan\");");
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(box + ("{" + flat(parts) + "}"), diagnostics);
  const auto plan = plan_slice(loaded, {}, diagnostics);
  ASSERT_TRUE(plan) << to_text(diagnostics);
  ASSERT_EQ(plan->request.check_texts.size(), 1u);
  uint64_t hits = 0;
  for (const auto& layer : plan->producer(0, plan->request.lattice.count[2], nullptr)) hits += layer.checks[0].count;
  // The ball has radius 1.
  const double voxel = 0.05 * 0.06 * 0.07;
  EXPECT_NEAR(static_cast<double>(hits) * voxel, 4.18879, 0.05);
}

}  // namespace ombre::compile
