#include "jobs/stacks/material_changes.h"
#include "jobs/stacks/test_stacks.h"

namespace ombre::compile {
namespace {

class Diff : public StackTest {
 protected:
  ComparedSource design(const std::string& text) {
    Diagnostics diagnostics;
    const auto source = compared_design(load(text), diagnostics);
    EXPECT_TRUE(source) << to_text(diagnostics);
    return *source;
  }

  MaterialChanges changes(const ComparedSource& a, const ComparedSource& b,
                          const std::array<std::optional<Pitch>, 3>& pitch = {}) {
    Diagnostics diagnostics;
    CheckWork work;
    work.threads = 2;
    const CommonLattice common = common_lattice(a, b, pitch);
    const auto first = compared_solid(a, common, work, diagnostics);
    const auto second = compared_solid(b, common, work, diagnostics);
    EXPECT_TRUE(first && second) << to_text(diagnostics);
    lattice_ = common.sampling.lattice;
    return material_changes(*first, *second, lattice_, work);
  }

  voxel::Lattice lattice_;
};

const std::string block = "rectprism([2, 2, 2], red);";

}  // namespace

// Blocks of 20 voxels; the moved one leaves 3 x 20 x 20 voxels behind.
TEST_F(Diff, ABlockThatMovesLosesAndGains) {
  const MaterialChanges all = changes(design(block), design("translate(0.3, 0, 0) " + block));
  EXPECT_EQ(all.inside[0], 8000U);
  EXPECT_EQ(all.inside[1], 8000U);
  EXPECT_EQ(all.lost(), 1200U);
  EXPECT_EQ(all.gained(), 1200U);
  EXPECT_EQ(all.changed(), 0U);
  EXPECT_EQ(all.box, (IndexBox{{0, 0, 0}, {23, 20, 20}}));
  ASSERT_EQ(all.layers.size(), 20U);
  EXPECT_EQ(all.layers[0].voxels, 120U);
}

TEST_F(Diff, AMaterialThatIsExchangedChangesAllOfIt) {
  const MaterialChanges all = changes(design(block), design("rectprism([2, 2, 2], blue);"));
  EXPECT_EQ(all.lost(), 0U);
  EXPECT_EQ(all.gained(), 0U);
  EXPECT_EQ(all.changed(), 8000U);
  ASSERT_EQ(all.voxels.size(), 1U);
  const auto [from, to] = all.voxels.begin()->first;
  EXPECT_EQ(all.names[from], "red");
  EXPECT_EQ(all.names[to], "blue");
}

TEST_F(Diff, AStackIsItsDesignWithEveryDither) {
  for (const std::string& dither : voxel::dither_names()) {
    options_.dither = *voxel::dither(dither);
    options_.seed = 5;
    write_stack(load(graded_text));
    const MaterialChanges all = changes(compared_stack(folder()), design(graded_text));
    EXPECT_TRUE(all.layers.empty()) << dither;
    EXPECT_GT(all.inside[0], 1000U);
    EXPECT_EQ(all.inside[0], all.inside[1]);
  }
}

// The stack has voxels of 0.2 mm, and each of its voxels is eight of the comparison.
TEST_F(Diff, TheFinerVoxelsAreThoseOfBoth) {
  write_stack(load(block));
  const Pitch fine{1, 10};
  const MaterialChanges all =
      changes(compared_stack(folder()), design("translate(0, 0, 0.2) " + block), {fine, fine, fine});
  EXPECT_EQ(lattice_.count, (std::array<int64_t, 3>{20, 20, 22}));
  EXPECT_EQ(all.lost(), 2U * 20 * 20);
  EXPECT_EQ(all.gained(), 2U * 20 * 20);
}

}  // namespace ombre::compile
