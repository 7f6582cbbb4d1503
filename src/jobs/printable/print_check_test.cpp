#include "jobs/printable/print_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "jobs/printable/held_regions.h"
#include "jobs/stacks/test_stacks.h"

namespace ombre::compile {
namespace {

constexpr int64_t cells_along = 9;

// Random voxels in a cube with an empty border.
BitLayers random_region(std::mt19937& random, int64_t margin, double share) {
  BitLayers region{0, std::vector<BitLayer>(static_cast<size_t>(cells_along), BitLayer(cells_along + 60, cells_along))};
  for (int64_t k = margin; k < cells_along - margin; ++k)
    for (int64_t j = margin; j < cells_along - margin; ++j)
      for (int64_t i = margin; i < cells_along + 60 - margin; ++i)
        if (std::uniform_real_distribution<>()(random) < share) region.layers[static_cast<size_t>(k)].set(i, j);
  return region;
}

bool get(const BitLayers& region, int64_t i, int64_t j, int64_t k) {
  if (k < region.first || k >= region.end()) return false;
  const BitLayer& layer = region.at(k);
  return i >= 0 && j >= 0 && i < layer.width() && j < layer.height() && layer.get(i, j);
}

// Numbers the pieces by flooding them.
std::vector<FlagPiece> flooded(const BitLayers& region) {
  std::vector<FlagPiece> pieces;
  BitLayers left = region;
  for (int64_t k = 0; k < cells_along; ++k)
    for (int64_t j = 0; j < cells_along; ++j)
      for (int64_t i = 0; i < cells_along + 60; ++i) {
        if (!get(left, i, j, k)) continue;
        FlagPiece piece{0, {{i, j, k}, {i + 1, j + 1, k + 1}}};
        std::vector<std::array<int64_t, 3>> open{{i, j, k}};
        while (!open.empty()) {
          const auto [x, y, z] = open.back();
          open.pop_back();
          if (!get(left, x, y, z)) continue;
          left.layers[static_cast<size_t>(z)].row(y)[x / 64] &= ~(uint64_t{1} << (x % 64));
          ++piece.voxels;
          piece.box.lo = {std::min(piece.box.lo[0], x), std::min(piece.box.lo[1], y), std::min(piece.box.lo[2], z)};
          piece.box.hi = {std::max(piece.box.hi[0], x + 1), std::max(piece.box.hi[1], y + 1),
                          std::max(piece.box.hi[2], z + 1)};
          for (const int64_t d : {-1, 1})
            for (const auto& next : {std::array{x + d, y, z}, std::array{x, y + d, z}, std::array{x, y, z + d}})
              open.push_back(next);
        }
        pieces.push_back(piece);
      }
  return pieces;
}

}  // namespace

TEST(BitLayers, DilationIsTheUnionOfCopies) {
  std::mt19937 random(1);
  for (const Offsets& offsets : {ball_offsets(0.4, {0.1, 0.1, 0.1}), ball_offsets(0.5, {0.1, 0.2, 0.15}),
                                 offsets_within(0.21, {0.1, 0.1, 0.1}), offsets_nearer(0.2, {0.1, 0.15, 0.1})}) {
    const BitLayers region = random_region(random, 0, 0.02);
    const BitLayers made = dilated(region, offsets, -2, cells_along + 2);
    for (int64_t k = -2; k < cells_along + 2; ++k)
      for (int64_t j = 0; j < cells_along; ++j)
        for (int64_t i = 0; i < cells_along + 60; ++i) {
          const bool is_near = std::ranges::any_of(offsets.spans, [&](const OffsetSpan& span) {
            for (int64_t x = span.from; x <= span.to; ++x)
              if (get(region, i - x, j - span.j, k - span.k)) return true;
            return false;
          });
          ASSERT_EQ(get(made, i, j, k), is_near) << i << ' ' << j << ' ' << k;
        }
  }
}

TEST(FlagPieces, AreThoseOfAFlood) {
  std::mt19937 random(2);
  for (const double share : {0.05, 0.2, 0.31, 0.5}) {
    const BitLayers region = random_region(random, 1, share);
    FlagPieceFinder finder;
    for (int64_t k = 0; k < cells_along; ++k) finder.add(k, region.at(k));
    const FlagPieces found = finder.finish();
    std::vector<FlagPiece> expected = flooded(region);
    EXPECT_EQ(found.count, expected.size());
    std::ranges::stable_sort(expected, std::greater<>(), &FlagPiece::voxels);
    ASSERT_EQ(found.largest.size(), std::min<size_t>(expected.size(), FlagPieceFinder::most));
    EXPECT_EQ(found.largest.front(), expected.front());
    for (size_t n = 0; n < found.largest.size(); ++n) EXPECT_EQ(found.largest[n].voxels, expected[n].voxels);
  }
}

// Void that a flood from outside, which may not rise above the layer, does not reach.
TEST(HeldRegions, AreThoseOfFloodsLayerByLayer) {
  std::mt19937 random(3);
  for (const double share : {0.2, 0.4, 0.6}) {
    const BitLayers open = inverted(random_region(random, 1, share));
    BitLayers held{0, std::vector<BitLayer>(static_cast<size_t>(cells_along), BitLayer(cells_along + 60, cells_along))};
    for (int64_t top = 0; top < cells_along; ++top) {
      BitLayers below = open;
      below.layers.resize(static_cast<size_t>(top + 1));
      BitLayers reached = below;
      for (BitLayer& layer : reached.layers) layer = BitLayer(cells_along + 60, cells_along);
      std::vector<std::array<int64_t, 3>> next_to{{0, 0, 0}};
      while (!next_to.empty()) {
        const auto [x, y, z] = next_to.back();
        next_to.pop_back();
        if (!get(below, x, y, z) || get(reached, x, y, z)) continue;
        reached.layers[static_cast<size_t>(z)].set(x, y);
        for (const int64_t d : {-1, 1})
          for (const auto& next : {std::array{x + d, y, z}, std::array{x, y + d, z}, std::array{x, y, z + d}})
            next_to.push_back(next);
      }
      const auto at = static_cast<size_t>(top);
      held.layers[at] = below.layers[at];
      held.layers[at].remove(reached.layers[at]);
    }
    uint64_t cups = 0, voxels = 0;
    for (const FlagPiece& piece : flooded(held)) {
      bool opens = false;
      // A cup's box may hold voxels of other pieces, so pieces of one voxel are compared, which have no others.
      const auto [x, y, z] = piece.box.lo;
      if (piece.voxels == 1) opens = get(open, x, y, z + 1) && !get(held, x, y, z + 1);
      cups += opens ? 1 : 0;
    }
    HeldRegionFinder finder;
    BitLayer outside(cells_along + 60, cells_along);
    outside.invert();
    finder.add(-1, outside);
    for (int64_t k = 0; k < cells_along; ++k) {
      BitLayer expected = k > 0 ? held.at(k - 1) : BitLayer(cells_along + 60, cells_along);
      (expected &= open.at(k)).remove(held.at(k));
      const BitLayer mouths = finder.add(k, open.at(k));
      voxels += mouths.count();
      for (int64_t j = 0; j < cells_along; ++j)
        EXPECT_TRUE(std::equal(mouths.row(j), mouths.row(j) + mouths.words(), expected.row(j)));
    }
    finder.add(cells_along, outside);
    EXPECT_GE(finder.finish().count, cups);
    EXPECT_GT(voxels, 0U);
  }
}

class PrintChecks : public StackTest {
 protected:
  PrintChecks() { options_.pitch = {Pitch{1, 10}, Pitch{1, 10}, Pitch{1, 10}}; }

  std::vector<PrintFinding> found(const std::string& text, const CheckLimits& limits) {
    const Plan planned = plan(load(text));
    planned.stages->prepare({});
    CheckRun run;
    run.threads = threads_;
    run.memory_bytes = memory_;
    return run_print_checks(planned, print_checks(limits, planned.request), run);
  }
  static CheckLimits details(double fails_mm) { return {voxel::SmallestFeature{0, fails_mm}, {}, false}; }
  static const PrintFinding* of_kind(const std::vector<PrintFinding>& all, const std::string& kind) {
    const auto at = std::ranges::find(all, kind, &PrintFinding::kind);
    return at == all.end() ? nullptr : &*at;
  }

  int threads_ = 2;
  size_t memory_ = size_t{1} << 30;
};

// A wall of ten voxels.
TEST_F(PrintChecks, AWallBelowTheLimitIsFoundWhole) {
  const std::string wall = "rectprism([4, 1, 3], red);";
  EXPECT_TRUE(found(wall, details(1)).empty());
  const auto all = found(wall, details(1.05));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].kind, "thin");
  EXPECT_TRUE(all[0].is_error);
  EXPECT_EQ(all[0].pieces.count, 1U);
  EXPECT_EQ(all[0].pieces.voxels, 40U * 10 * 30);
  EXPECT_EQ(all[0].pieces.largest[0].box, (IndexBox{{0, 0, 0}, {40, 10, 30}}));
}

TEST_F(PrintChecks, EdgesCornersAndCurvesAreNoThinPlaces) {
  for (const char* solid :
       {"rectprism([3, 3, 3], red);", "sphere(2, red);", "rotate(30, 40, 50) rectprism([3, 2, 3], red);",
        "difference() { rectprism([4, 4, 4], red); translate(2, 2, 2) rectprism([4, 4, 4], red); }",
        "cylinder(1, 3, red);", "torus(3, 0.6, red);"})
    for (const double limit : {0.3, 0.5, 0.8}) EXPECT_TRUE(found(solid, details(limit)).empty()) << solid << limit;
}

// A fin of 0.2 mm on a block: it is found but for its root, which is excused as a corner is.
TEST_F(PrintChecks, AFinOnABlockIsFound) {
  const auto all =
      found("union() { rectprism([4, 4, 2], red); translate(0, 0, 2) rectprism([4, 0.2, 2.4], red); }", details(0.5));
  ASSERT_EQ(all.size(), 1U);
  const IndexBox& box = all[0].pieces.largest[0].box;
  EXPECT_EQ(box.hi, (std::array<int64_t, 3>{40, 21, 42}));
  EXPECT_EQ(box.lo[1], 19);
  EXPECT_GE(box.lo[2], 20);
  EXPECT_LE(box.lo[2], 24);
}

// Two blocks 0.3 mm apart, 2 mm of each beside the other.
TEST_F(PrintChecks, AGapBelowTheLimitIsFound) {
  const std::string blocks = "union() { rectprism([2, 2, 2], red); translate(2.3, 0, 0) rectprism([2, 2, 2], red); }";
  EXPECT_FALSE(of_kind(found(blocks, details(0.3)), "gap"));
  const auto all = found(blocks, details(0.4));
  const PrintFinding* gap = of_kind(all, "gap");
  ASSERT_TRUE(gap);
  EXPECT_EQ(gap->pieces.count, 1U);
  EXPECT_EQ(gap->pieces.largest[0].box.lo[0], 20);
  EXPECT_EQ(gap->pieces.largest[0].box.hi[0], 23);
  // The second block is a body of its own: a warning.
  const PrintFinding* bodies = of_kind(all, "bodies");
  ASSERT_TRUE(bodies);
  EXPECT_FALSE(bodies->is_error);
  EXPECT_EQ(bodies->pieces.count, 1U);
  EXPECT_EQ(bodies->pieces.voxels, 8000U);
}

TEST_F(PrintChecks, ClosedHollowsAreFoundAndOpenOnesAreNot) {
  const std::string block = "rectprism([3, 3, 3], red); rectprism([1, 1, 1], red);";
  const auto all = found("difference() { " + block + " }", {});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].kind, "hollow");
  EXPECT_EQ(all[0].pieces.voxels, 1000U);
  EXPECT_EQ(all[0].pieces.largest[0].box, (IndexBox{{10, 10, 10}, {20, 20, 20}}));
  EXPECT_TRUE(found("difference() { " + block + " cylinder(0.3, 9, red); }", {}).empty());
}

// A core of 20 voxels, 2 voxels below the surface: the outermost of its voxels are 0.2 mm from it, the next 0.3 mm.
TEST_F(PrintChecks, MaterialsKeepTheirDistance) {
  const std::string part =
      "union() { rectprism([2, 2, 2], blue);"
      "difference() { rectprism([2.4, 2.4, 2.4], red); rectprism([2, 2, 2], red); } }";
  const auto rule = [](double mm, const char* near) {
    CheckLimits limits;
    limits.neighbours = {{"blue", near, mm}};
    return limits;
  };
  EXPECT_TRUE(found(part, rule(0.2, "surface")).empty());
  const auto all = found(part, rule(0.3, "surface"));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].kind, "neighbour");
  EXPECT_EQ(all[0].pieces.voxels, 20U * 20 * 20 - 18 * 18 * 18);
  EXPECT_EQ(found(part, rule(0.05, "red"))[0].pieces.voxels, 20U * 20 * 20 - 18 * 18 * 18);
  EXPECT_TRUE(found(part, rule(5, "clear")).empty());  // the part has no such material
}

std::string box(Vec3 lo, Vec3 hi, const std::string& material) {
  const Vec3 middle = 0.5 * (lo + hi), size = hi - lo;
  const auto numbers = [](Vec3 v) {
    return std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z);
  };
  return "translate(" + numbers(middle) + ") rectprism([" + numbers(size) + "], " + material + ");\n";
}

std::string without(const std::string& solid, const std::string& removed) {
  return "difference() { union() { " + solid + "} union() { " + removed + "} }";
}

// A pillar with a beam of 2 mm along x at its top, from whose free end a tooth hangs down. The tooth begins in the air,
// and the beam bridges what lies between the pillar and the tooth.
TEST_F(PrintChecks, AToothBeginsAsAnIslandAndABeamHangsOver) {
  CheckLimits limits;
  limits.overhang_degrees = 45;
  for (const int gap : {3, 10})
    for (const int wide : {1, 12})
      for (const int tooth : {1, 6}) {
        const double y = wide / 10.0, x = gap / 10.0, foot = 3 - tooth / 10.0;
        const auto all =
            found("union() { " + box({-1, 0, 0}, {0, y, 4}, "red") + box({-1, 0, 3}, {x + 0.5, y, 4}, "red") +
                      box({x, 0, foot}, {x + 0.5, y, 3}, "red") + "}",
                  limits);
        const PrintFinding *island = of_kind(all, "island"), *hanging = of_kind(all, "overhang");
        ASSERT_TRUE(island);
        EXPECT_TRUE(island->is_error);
        EXPECT_EQ(island->pieces.count, 1U);
        EXPECT_EQ(island->layer, 30 - tooth);
        EXPECT_EQ(island->pieces.largest[0].box,
                  (IndexBox{{10 + gap, 0, 30 - tooth}, {10 + gap + 5, wide, 31 - tooth}}));
        // The outermost voxels of the beam's lower side stand on their neighbours.
        ASSERT_TRUE(hanging);
        EXPECT_FALSE(hanging->is_error);
        EXPECT_EQ(hanging->pieces.voxels, static_cast<uint64_t>((gap - 2) * wide));
        EXPECT_EQ(all.size(), 2U);
      }
}

// Returns how many of the voxels that a square layer has beyond the one below it are too far from that, if it reaches
// `step` voxels farther on all sides. Sides of voxels that touch are 0 apart, and so on.
int hanging_voxels(int width_below, int step, double reach) {
  int at_side = 0, at_corner = 0;
  for (int a = 0; a < step; ++a) {
    at_side += a > reach - 1e-5 ? 1 : 0;
    for (int b = 0; b < step; ++b) at_corner += std::hypot(a, b) > reach - 1e-5 ? 1 : 0;
  }
  return 4 * (at_side * width_below + at_corner);
}

// An inverted pyramid of steps, whose slope is atan(step) from the vertical.
TEST_F(PrintChecks, SlopesUpToTheOverhangSupportThemselves) {
  for (const int step : {1, 2, 3})
    for (const double degrees : {20.0, 45.0, 63.5, 71.6}) {
      std::string steps;
      uint64_t hanging = 0;
      for (int k = 0; k < 6; ++k) {
        const double half = 0.5 + 0.1 * step * k;
        steps += box({-half, -half, 0.1 * k}, {half, half, 0.1 * (k + 1)}, "red");
        const double reach = std::tan(degrees * std::numbers::pi / 180);
        if (k > 0) hanging += static_cast<uint64_t>(hanging_voxels(10 + 2 * step * (k - 1), step, reach));
      }
      CheckLimits limits;
      limits.overhang_degrees = degrees;
      const auto all = found("union() { " + steps + "}", limits);
      const PrintFinding* overhang = of_kind(all, "overhang");
      EXPECT_EQ(overhang ? overhang->pieces.voxels : 0, hanging) << step << ' ' << degrees;
      EXPECT_FALSE(of_kind(all, "island"));
    }
}

TEST_F(PrintChecks, CupsHoldWhatFlowsOutNeitherBelowNorBesides) {
  CheckLimits limits;
  limits.is_vat = true;
  const std::string block = box({0, 0, 0}, {3, 3, 3}, "red");
  for (const double depth : {0.1, 1.3})
    for (const double wide : {0.2, 1.5}) {
      const std::string pocket = box({0.5, 1, 3 - depth}, {0.5 + wide, 2, 4}, "red");
      const auto all = found(without(block, pocket), limits);
      ASSERT_EQ(all.size(), 1U);
      EXPECT_EQ(all[0].kind, "cup");
      EXPECT_EQ(all[0].layer, 29);
      EXPECT_EQ(all[0].pieces.count, 1U);
      EXPECT_EQ(all[0].pieces.voxels, static_cast<uint64_t>(std::lround(depth * wide * 1 * 1000)));
      // A drain at the bottom; a channel to a side, which leaves what is below it.
      EXPECT_TRUE(found(without(block, pocket + box({0.6, 1.4, -1}, {0.7, 1.5, 3}, "red")), limits).empty());
      if (depth < 1) continue;
      const auto notched = found(without(block, pocket + box({-1, 1, 2.5}, {0.6, 1.2, 4}, "red")), limits);
      ASSERT_EQ(notched.size(), 1U);
      EXPECT_EQ(notched[0].pieces.voxels, static_cast<uint64_t>(std::lround((depth - 0.5) * wide * 1 * 1000)));
    }
  // Hollows that stay closed are no cups, and neither are openings at the bottom.
  EXPECT_EQ(found(without(block, box({1, 1, 1}, {2, 2, 2}, "red")), limits)[0].kind, "hollow");
  EXPECT_TRUE(found(without(block, box({1, 1, -1}, {2, 2, 2}, "red")), limits).empty());
}

TEST_F(PrintChecks, SupportInAClosedHollowIsTrapped) {
  CheckLimits limits;
  limits.support = "support";
  const std::string shell = without(box({0, 0, 0}, {3, 3, 3}, "red"), box({1, 1, 1}, {2, 2, 2}, "red"));
  const auto all = found("union() { " + shell + box({1, 1, 1}, {2, 2, 1.5}, "support") + "}", limits);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].kind, "hollow");
  EXPECT_EQ(all[0].pieces.voxels, 1000U);
  // Support that reaches the outside comes out, and so does what is behind it.
  const std::string shaft = box({1.3, 1.3, 2}, {1.5, 1.5, 3}, "support");
  const std::string drained = without(shell, box({1.3, 1.3, 2}, {1.5, 1.5, 3}, "red")) + shaft;
  EXPECT_TRUE(found("union() { " + drained + "}", limits).empty());
  // A body on a pillar of support is loose once that is removed.
  const auto loose = found("union() { " + box({0, 0, 0}, {3, 3, 1}, "red") + box({1, 1, 1}, {2, 2, 2}, "support") +
                               box({1, 1, 2}, {2, 2, 3}, "blue") + "}",
                           limits);
  ASSERT_EQ(loose.size(), 1U);
  EXPECT_EQ(loose[0].kind, "bodies");
  EXPECT_EQ(loose[0].pieces.voxels, 1000U);
}

TEST_F(PrintChecks, ThreadsAndMemoryChangeNothing) {
  const std::string foam =
      "intersection() { rectprism([6, 6, 6], red); tpms(\"gyroid\", cell = [2, 2, 2], thickness = 0.25, material = "
      "\"red\"); }";
  CheckLimits limits{voxel::SmallestFeature{0.5, 0.3}, {{"red", "surface", 0.1}}, false};
  const auto expected = found(foam, limits);
  EXPECT_FALSE(expected.empty());
  threads_ = 1;
  memory_ = 1;
  const auto all = found(foam, limits);
  ASSERT_EQ(all.size(), expected.size());
  for (size_t n = 0; n < all.size(); ++n) {
    EXPECT_EQ(all[n].text, expected[n].text);
    EXPECT_EQ(all[n].pieces.count, expected[n].pieces.count);
    EXPECT_EQ(all[n].pieces.largest, expected[n].pieces.largest);
    EXPECT_EQ(all[n].layer, expected[n].layer);
  }
}

}  // namespace ombre::compile
