#include "jobs/printable/fix_job.h"

#include <algorithm>

#include "jobs/stacks/test_stacks.h"

namespace ombre::compile {
namespace {

class Fixes : public StackTest {
 protected:
  Fixes() { options_.pitch = {Pitch{1, 10}, Pitch{1, 10}, Pitch{1, 10}}; }

  struct Fixed {
    CorrectedJob job;
    std::vector<PrintFinding> left;  // what the same checks find afterwards

    MaterialId id(const std::string& name) const { return id_of(job.plan.request, name); }
    // Returns the voxels that a material gains by all corrections.
    int64_t gained(const std::string& name) const {
      int64_t sum = 0;
      for (const Correction& correction : job.corrections)
        if (const auto its = correction.gained.find(id(name)); its != correction.gained.end()) sum += its->second;
      return sum;
    }
    // Returns the materials of the voxels of all layers, x fastest.
    std::vector<MaterialId> voxels() const {
      std::vector<MaterialId> all;
      for (const auto& layer : job.plan.producer(0, job.plan.request.lattice.count[2], nullptr))
        for (uint32_t j = 0; j < layer.materials().height(); ++j) {
          all.resize(all.size() + layer.materials().width());
          layer.materials().row(j).unpack(all.data() + all.size() - layer.materials().width());
        }
      return all;
    }
  };

  Fixed fixed(const std::string& text, const CheckLimits& limits, FixRules rules, const std::string& neutral = "") {
    const Plan planned = plan(load(text));
    planned.stages->prepare({});
    CheckRun run;
    run.threads = threads_;
    run.memory_bytes = memory_;
    if (limits.details) rules.thick_mm = limits.details->fails_mm;
    rules.neutral = id_of(planned.request, neutral);
    const auto checks = print_checks(limits, planned.request);
    Fixed result{correct_job(planned, checks, rules, run), {}};
    result.left = run_print_checks(result.job.plan, checks, run);
    return result;
  }
  static CheckLimits walls(double mm) { return {voxel::SmallestFeature{0, mm}, {}, false}; }

  int threads_ = 2;
  size_t memory_ = size_t{1} << 30;
};

std::string plate(int length, int thickness, int height, const std::string& material) {
  return "rectprism([" + std::to_string(length / 10.0) + ", " + std::to_string(thickness / 10.0) + ", " +
         std::to_string(height / 10.0) + "], " + material + ");";
}

// The wall of a hollow is 4 voxels thick at x = 1.1 to 1.5 mm, and thicker elsewhere. A ball of one voxel cuts a line,
// and one of three voxels, a cube without its corners, a channel of 3 x 3 voxels.
TEST_F(Fixes, HollowsGetADrainWhereTheWallIsThinnest) {
  const std::string box = "difference() { rectprism([3, 3, 3], red); translate(0.6, 0, 0) rectprism([1, 1, 1], red); }";
  for (const auto& [diameter, cut] : {std::pair{0.1, 4}, {0.3, 36}}) {
    FixRules rules;
    rules.drain_mm = diameter;
    for (const int threads : {1, 3}) {
      threads_ = threads;
      const Fixed drained = fixed(box, {}, rules);
      EXPECT_EQ(drained.gained("red"), -cut);
      EXPECT_TRUE(drained.left.empty());
      EXPECT_EQ(drained.job.hollows_left, 0U);
      // The channel lies in the middle of the hollow, along x.
      const std::vector<MaterialId> voxels = drained.voxels();
      const auto at = [&](int i, int j, int k) { return voxels[static_cast<size_t>((k * 30 + j) * 30 + i)]; };
      EXPECT_TRUE(at(27, 14, 14) == 0 || at(27, 15, 15) == 0);
    }
  }
  FixRules none;
  EXPECT_EQ(fixed(box, {}, none).left.size(), 1U);
}

// A hollow with a hollow block in it: the outer wall has 10 voxels, that of the block 5.
TEST_F(Fixes, HollowsWithinHollowsAreOpenedToo) {
  FixRules rules;
  rules.drain_mm = 0.3;
  const Fixed drained = fixed(
      "difference() { rectprism([5, 5, 5], red); rectprism([3, 3, 3], red); } "
      "difference() { rectprism([2, 2, 2], red); rectprism([1, 1, 1], red); }",
      {}, rules);
  EXPECT_EQ(drained.gained("red"), -9 * (10 + 5));
  for (const PrintFinding& finding : drained.left) EXPECT_NE(finding.kind, "hollow");
  EXPECT_EQ(drained.job.corrections.size(), 2U);
}

// A ball of two voxels is a cube, one of three is a cube without its eight corners. A plate of one voxel, of p by q,
// grows by them to 2 (p + 1) (q + 1) and to 3 (p + 2) (q + 2) - 8 voxels.
TEST_F(Fixes, PlatesGrowToTheLimit) {
  for (const auto& [p, q] : {std::pair{30, 20}, {7, 41}}) {
    const Fixed two = fixed(plate(p, 1, q, "red"), walls(0.2), {});
    EXPECT_EQ(two.gained("red"), 2 * (p + 1) * (q + 1) - p * q);
    EXPECT_TRUE(two.left.empty());
    const Fixed three = fixed(plate(p, 1, q, "red"), walls(0.3), {});
    EXPECT_EQ(three.gained("red"), 3 * (p + 2) * (q + 2) - 8 - p * q);
    EXPECT_TRUE(three.left.empty());
    const voxel::Lattice& lattice = three.job.plan.request.lattice;
    EXPECT_EQ(lattice.count, (std::array<int64_t, 3>{p + 2, 3, q + 2}));
    EXPECT_NEAR(lattice.origin.x, -p / 20.0 - 0.1, 1e-9);
  }
}

// A wall gets the thickness of the limit, except near its ends.
TEST_F(Fixes, WallsHaveTheThicknessOfTheLimit) {
  for (int limit = 2; limit <= 6; ++limit)
    for (int thickness = 1; thickness < limit; ++thickness) {
      const Fixed wall = fixed(plate(30, thickness, 30, "red"), walls(0.1 * limit), {});
      EXPECT_TRUE(wall.left.empty()) << thickness << ' ' << limit;
      const auto& count = wall.job.plan.request.lattice.count;
      const auto voxels = wall.voxels();
      const auto at = [&](int64_t i, int64_t j, int64_t k) {
        return voxels[static_cast<size_t>((k * count[1] + j) * count[0] + i)];
      };
      int across = 0;
      for (int64_t j = 0; j < count[1]; ++j) across += at(count[0] / 2, j, count[2] / 2) != 0;
      EXPECT_EQ(across, limit);
      EXPECT_EQ(static_cast<int64_t>(voxels.size()) - std::ranges::count(voxels, MaterialId{0}),
                30 * thickness * 30 + wall.gained("red"));
    }
}

TEST_F(Fixes, WhatIsThickStays) {
  for (const char* solid : {"rectprism([3, 3, 3], red);", "sphere(2, red);", "torus(3, 0.6, red);"})
    EXPECT_TRUE(fixed(solid, walls(0.5), {}).job.corrections.empty()) << solid;
}

TEST_F(Fixes, FinsAndRodsArePrintableThen) {
  for (const char* solid :
       {"union() { rectprism([4, 4, 2], red); translate(0, 0, 2) rectprism([4, 0.2, 2.4], red); }",
        "union() { sphere(1.5, red); cylinder(0.15, 5, red); }", "rotate(20, 30, 40) rectprism([3, 0.2, 3], red);",
        "difference() { sphere(2, red); sphere(1.8, red); }"}) {
    const Fixed job = fixed(solid, walls(0.5), {});
    EXPECT_GT(job.gained("red"), 0) << solid;
    EXPECT_TRUE(std::ranges::find(job.left, "thin", &PrintFinding::kind) == job.left.end()) << solid;
  }
}

TEST_F(Fixes, AddedVoxelsAreOfTheNearestMaterial) {
  const Fixed job = fixed(
      "union() { translate(-1, 0, 0) rectprism([2, 0.1, 2], red);"
      "translate(1, 0, 0) rectprism([2, 0.1, 2], blue); }",
      walls(0.2), {});
  // 20 x 20 voxels each; the ball grows towards greater x, y and z.
  EXPECT_EQ(job.gained("red"), 20 * 2 * 21 - 20 * 20);
  EXPECT_EQ(job.gained("blue"), 21 * 2 * 21 - 20 * 20);
}

TEST_F(Fixes, ALatticeThatMayNotGrowKeepsItsBox) {
  FixRules rules;
  rules.may_grow = false;
  const Fixed job = fixed("union() { " + plate(10, 1, 10, "red") + "translate(0, 2, 0) " + plate(4, 4, 4, "red") + "}",
                          walls(0.3), rules);
  EXPECT_EQ(job.job.plan.request.lattice.count, (std::array<int64_t, 3>{10, 23, 10}));
  // The plate lies at the lower side of the box, so one layer of voxels is added above it: the slice of the ball is a
  // cross, and of its growth nothing lies outside.
  EXPECT_EQ(job.gained("red"), 10 * 10);
}

TEST_F(Fixes, LooseBodiesBelowAVolumeAreDropped) {
  const auto cube = [](double at, int voxels) {
    const std::string size = std::to_string(voxels / 10.0);
    return "translate(" + std::to_string(at) + ", 0, 0) rectprism([" + size + ", " + size + ", " + size + "], red);";
  };
  const std::string part =
      "union() { rectprism([2, 2, 2], red); " + cube(2, 2) + cube(-2.5, 2) + cube(3, 4) + cube(-4, 6) + "}";
  FixRules rules;
  for (const auto& [below_mm3, dropped] : {std::pair{0.008, 0}, {0.0081, 16}, {0.064, 16}, {0.1, 80}, {100.0, 296}}) {
    rules.drop_below_mm3 = below_mm3;
    const Fixed job = fixed(part, {}, rules);
    EXPECT_EQ(job.gained("red"), -dropped) << below_mm3;
    EXPECT_EQ(job.left.empty(), dropped == 296);
  }
}

// The outermost voxels of a core of 20 voxels along each axis are 0.2 mm from the surface, the next ones 0.3 mm.
TEST_F(Fixes, ShellsKeepNeighboursApart) {
  const std::string part =
      "union() { rectprism([2, 2, 2], blue); translate(3, 0, 0) rectprism([1, 1, 1], clear);"
      "difference() { rectprism([2.4, 2.4, 2.4], red); rectprism([2, 2, 2], red); } }";
  for (const char* near : {"surface", "red"})
    for (const int layers : {1, 2}) {
      CheckLimits limits;
      limits.neighbours = {{"blue", near, (near == std::string("red") ? 0.05 : 0.25) + 0.1 * (layers - 1)}};
      const Fixed job = fixed(part, limits, {}, "clear");
      const int left = 20 - 2 * layers;
      EXPECT_EQ(job.gained("blue"), left * left * left - 8000);
      EXPECT_EQ(job.gained("clear"), 8000 - left * left * left);
      EXPECT_EQ(job.gained("red"), 0);
      EXPECT_TRUE(std::ranges::find(job.left, "neighbour", &PrintFinding::kind) == job.left.end());
    }
}

TEST_F(Fixes, ThreadsAndMemoryChangeNothing) {
  const std::string foam =
      "intersection() { rectprism([4, 4, 4], red); tpms(\"gyroid\", cell = [2, 2, 2], thickness = 0.25, material = "
      "\"red\"); }";
  FixRules rules;
  rules.drop_below_mm3 = 0.1;
  const Fixed expected = fixed(foam, walls(0.4), rules);
  EXPECT_GT(expected.gained("red"), 0);
  threads_ = 1;
  memory_ = 1;
  const Fixed again = fixed(foam, walls(0.4), rules);
  EXPECT_EQ(again.voxels(), expected.voxels());
  EXPECT_EQ(again.gained("red"), expected.gained("red"));
}

}  // namespace
}  // namespace ombre::compile
