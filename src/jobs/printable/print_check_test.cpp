#include "jobs/printable/print_check.h"

#include <algorithm>
#include <random>

#include "jobs/stacks/test_stacks.h"

namespace ombre::compile {
namespace {

constexpr int64_t side = 9;

// Random voxels in a cube with an empty border.
BitLayers random_region(std::mt19937& random, int64_t margin, double share) {
  BitLayers region{0, std::vector<BitLayer>(static_cast<size_t>(side), BitLayer(side + 60, side))};
  for (int64_t k = margin; k < side - margin; ++k)
    for (int64_t j = margin; j < side - margin; ++j)
      for (int64_t i = margin; i < side + 60 - margin; ++i)
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
  for (int64_t k = 0; k < side; ++k)
    for (int64_t j = 0; j < side; ++j)
      for (int64_t i = 0; i < side + 60; ++i) {
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
    const BitLayers made = dilated(region, offsets, -2, side + 2);
    for (int64_t k = -2; k < side + 2; ++k)
      for (int64_t j = 0; j < side; ++j)
        for (int64_t i = 0; i < side + 60; ++i) {
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
    for (int64_t k = 0; k < side; ++k) finder.add(k, region.at(k));
    const FlagPieces found = finder.finish();
    std::vector<FlagPiece> expected = flooded(region);
    EXPECT_EQ(found.count, expected.size());
    std::ranges::stable_sort(expected, std::greater<>(), &FlagPiece::voxels);
    ASSERT_EQ(found.largest.size(), std::min<size_t>(expected.size(), FlagPieceFinder::most));
    EXPECT_EQ(found.largest.front(), expected.front());
    for (size_t n = 0; n < found.largest.size(); ++n) EXPECT_EQ(found.largest[n].voxels, expected[n].voxels);
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
