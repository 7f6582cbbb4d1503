#include "stages/lattice_source.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "questions/design_stages.h"
#include "stages/job_stages.h"

namespace ombre::compile {
namespace {

struct Stack {
  int64_t i = 0, j = 0, bottom = 0, top = 0;
};

// A stage that flags the given cells, whatever it reads.
class GivenStacks final : public design::SweepStage {
 public:
  GivenStacks(const Box& box, const Pitch& along_x, const Pitch& along_y, const Pitch& along_z,
              std::vector<Stack> stacks)
      : box_(box), cell_{along_x.mm(), along_y.mm(), along_z.mm()}, stacks_(std::move(stacks)) {}

  std::string name() const override { return "stacks"; }
  Hash content() const override { return {}; }
  Box bounds() const override { return box_; }
  design::LatticeChoice lattice() const override { return {cell_, true}; }
  std::vector<design::StageRead> reads() const override { return {}; }
  std::vector<design::StageChannel> channels(const std::vector<design::StageChannel>&) const override {
    return {{"inside", {}, 0, true, {0, 1}}};
  }
  double bytes_of_column() const override { return 0; }
  std::unique_ptr<Sweep> begin(const design::StageLattice&, const IndexBox&, const design::StageWork&) const override {
    return std::make_unique<AllAtTheEnd>(stacks_);
  }

 private:
  class AllAtTheEnd final : public Sweep {
   public:
    explicit AllAtTheEnd(const std::vector<Stack>& stacks) : stacks_(stacks) {}
    void take(const design::StageValues&, design::ColumnRuns&) override {}
    void finish(design::ColumnRuns& made) override {
      for (const Stack& s : stacks_) made.add(0, s.i, s.j, s.bottom, s.top, 1);
    }

   private:
    const std::vector<Stack>& stacks_;
  };

  Box box_;
  Vec3 cell_;
  std::vector<Stack> stacks_;
};

constexpr int cells = 6;

class FlaggedCells : public testing::Test {
 protected:
  void SetUp() override {
    lattice_.origin = {-3, 1, 2};
    lattice_.pitch = {Pitch{1, 2}, Pitch{3, 4}, Pitch{1, 1}};
    lattice_.count = {cells, cells, cells};
    box_ = lattice_.box();
    std::vector<Stack> stacks;
    for (int64_t column = 0; column < cells * cells; ++column)
      for (int64_t k = 0; k < cells; ++k)
        if (number(0, 1) < 0.4) {
          stacks.push_back({column % cells, column / cells, k, k + 1});
          filled_.insert({column, k});
        }
    const auto& pitch = lattice_.pitch;
    const auto stage = std::make_shared<const GivenStacks>(box_, pitch[0], pitch[1], pitch[2], stacks);
    const design::MaterialTable none;
    source_ = stages_->source(stage, {none, {}, {}, {}});
    stages_->prepare({});
  }

  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  Vec3 point(double beyond) {
    const Box box = box_.expanded(beyond);
    return {number(box.lo.x, box.hi.x), number(box.lo.y, box.hi.y), number(box.lo.z, box.hi.z)};
  }

  // Returns the distance to the nearest cell that is filled, or is not, by looking at all cells. Cells outside of the
  // lattice are empty.
  double away(Vec3 p, bool filled) const {
    double least = Box::inf;
    for (int i = -1; i <= cells; ++i)
      for (int j = -1; j <= cells; ++j)
        for (int k = -1; k <= cells; ++k) {
          const bool is_there =
              i >= 0 && j >= 0 && i < cells && j < cells && filled_.contains({int64_t{i} + cells * j, k});
          if (is_there != filled) continue;
          const Vec3 size = lattice_.voxel_mm(), lo = lattice_.center(i, j, k) - 0.5 * size, hi = lo + size;
          Vec3 out;
          for (int axis = 0; axis < 3; ++axis) out[axis] = std::max({lo[axis] - p[axis], p[axis] - hi[axis], 0.0});
          least = std::min(least, length(out));
        }
    return least;
  }

  voxel::Lattice lattice_;
  Box box_;
  std::set<std::pair<int64_t, int64_t>> filled_;
  JobStagesPtr stages_ = stages_of(design::Design());
  program::SourceField source_;
  std::mt19937 random_{1};
};

}  // namespace

TEST_F(FlaggedCells, AreTheirCells) {
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < cells; ++k) {
        const bool is_there = filled_.contains({int64_t{i} + cells * j, k});
        EXPECT_EQ(source_->sample(0, lattice_.center(i, j, k)), is_there ? 1 : 0);
      }
}

TEST_F(FlaggedCells, DistancesAreExactUpToACell) {
  constexpr double shortest = 0.5;
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = point(0);
    const bool is_inside = source_->sample(0, p) == 1;
    const double exact = std::min(away(p, !is_inside), shortest);
    EXPECT_NEAR(source_->sample(1, p), is_inside ? -exact : exact, 1e-12);
  }
}

TEST_F(FlaggedCells, DistancesAreBounds) {
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = point(3), q = p + Vec3{number(-1, 1), number(-1, 1), number(-1, 1)};
    const double here = source_->sample(1, p);
    EXPECT_LE(std::abs(here - source_->sample(1, q)), length(p - q) + 1e-12);
    if (here > 0) {
      EXPECT_LE(here, away(p, true) + 1e-12);
    }
    EXPECT_EQ(here <= 0, source_->sample(0, p) == 1);
  }
}

TEST_F(FlaggedCells, RangesHoldPoints) {
  for (int n = 0; n < 300; ++n) {
    const Vec3 lo = point(2);
    const Vec3 size{number(0, 2), number(0, 2), number(0, 2)};
    const Box box{lo, lo + size};
    for (const int channel : {0, 1}) {
      const Interval range = source_->range(channel, box);
      for (int i = 0; i < 10; ++i) {
        const Vec3 p = lo + Vec3{number(0, size.x), number(0, size.y), number(0, size.z)};
        EXPECT_TRUE(range.contains(source_->sample(channel, p)));
      }
    }
  }
}

}  // namespace ombre::compile
