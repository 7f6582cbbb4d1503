// Tests stages of each kind against plain computations over the whole lattice.
#include "design/stage.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <map>

#include "base/system/byte_pack.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/test_errors.h"
#include "jobs/grid/grid_job.h"
#include "jobs/test_designs.h"
#include "questions/design_stages.h"
#include "stages/job_stages.h"
#include "voxel/place_sources.h"

namespace ombre::compile {
namespace {

using design::StageChannel;
using design::StageValues;
using Cell = std::array<int64_t, 3>;

// A ball by its centre and radius, mm. Two of the test balls do not touch; one is small.
struct Ball {
  Vec3 centre;
  double radius = 0;
};
const std::vector<Ball> test_balls{{{-4, 0, 0}, 3.7}, {{4.3, 0.4, 0.9}, 3.2}, {{0.2, 4.1, 3.1}, 0.9}};
const std::string design_text =
    "union() { translate(-4, 0, 0) sphere(3.7); translate(4.3, 0.4, 0.9) sphere(3.2);"
    " translate(0.2, 4.1, 3.1) sphere(0.9); }";

bool is_in_balls(Vec3 p) {
  return std::ranges::any_of(test_balls, [&](const Ball& ball) { return length(p - ball.centre) <= ball.radius; });
}

// A stage that reads the shape of a solid and gives one channel.
template <class Kind>
class OneChannel : public Kind {
 public:
  OneChannel(design::NodePtr solid, Interval range) : solid_(std::move(solid)), range_(range) {}
  std::string name() const override { return "test"; }
  Hash content() const override { return {}; }
  Box bounds() const override { return solid_->bounds(design::design_space()); }
  std::vector<design::StageRead> reads() const override { return {{.solid = solid_, .inside = true}}; }
  std::vector<StageChannel> channels(const std::vector<StageChannel>&) const override {
    return {{"value", {}, 0, false, range_}};
  }

 private:
  design::NodePtr solid_;
  Interval range_;
};

// Counts the cells inside in a box around each cell; the sides of the box may be even.
class BoxCount final : public OneChannel<design::HaloStage> {
 public:
  BoxCount(const design::NodePtr& solid, const Cell& size) : OneChannel(solid, {0, 1e6}), size_(size) {}
  Reach reach(Vec3) const override {
    return {{size_[0] / 2, size_[1] / 2, size_[2] / 2}, {(size_[0] - 1) / 2, (size_[1] - 1) / 2, (size_[2] - 1) / 2}};
  }
  void compute(const StageValues& read, StageValues& made, Vec3 cell_mm, const StopFlag*) const override {
    const Reach reach = this->reach(cell_mm);
    const IndexBox& box = made.box();
    for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (int64_t j = box.lo[1]; j < box.hi[1]; ++j)
        for (int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
          float sum = 0;
          for (int64_t z = k - reach.below[2]; z <= k + reach.above[2]; ++z)
            for (int64_t y = j - reach.below[1]; y <= j + reach.above[1]; ++y)
              for (int64_t x = i - reach.below[0]; x <= i + reach.above[0]; ++x)
                sum += read.channel(0)[read.offset(x, y, z)];
          made.channel(0)[made.offset(i, j, k)] = sum;
        }
  }

 private:
  Cell size_;
};

// Counts the cells inside in each column, from the top down to each cell.
class SumFromTop final : public OneChannel<design::SweepStage> {
 public:
  explicit SumFromTop(const design::NodePtr& solid) : OneChannel(solid, {0, 1e6}) {}
  double bytes_of_column() const override { return sizeof(float); }
  std::unique_ptr<Sweep> begin(const design::StageLattice&, const IndexBox& cells,
                               const design::StageWork&) const override {
    return std::make_unique<Sums>(cells);
  }

 private:
  class Sums final : public Sweep {
   public:
    explicit Sums(const IndexBox& cells) : sums_(static_cast<size_t>(cells.size(0) * cells.size(1)), 0.0f) {}
    void take(const StageValues& layer, design::ColumnRuns& made) override {
      const IndexBox& box = layer.box();
      size_t n = 0;
      for (int64_t j = box.lo[1]; j < box.hi[1]; ++j)
        for (int64_t i = box.lo[0]; i < box.hi[0]; ++i, ++n) {
          sums_[n] += layer.channel(0)[n];
          if (sums_[n] > 0) made.add(0, i, j, box.lo[2], box.hi[2], sums_[n]);
        }
    }

   private:
    std::vector<float> sums_;
  };
};

// Returns for each cell the number of cells of the connected part to which it belongs.
std::vector<float> sizes_of_parts(const std::vector<float>& inside, const IndexBox& box) {
  const StageValues frame(box, 0);
  std::vector<float> sizes(inside.size(), 0.0f);
  for (size_t n = 0; n < inside.size(); ++n) {
    if (inside[n] == 0 || sizes[n] != 0) continue;
    std::vector<size_t> part;
    std::deque<size_t> waiting{n};
    sizes[n] = 1;
    while (!waiting.empty()) {
      const size_t at = waiting.front();
      waiting.pop_front();
      part.push_back(at);
      const auto width = box.size(0), layer = box.size(0) * box.size(1), c = static_cast<int64_t>(at);
      const Cell cell{box.lo[0] + c % width, box.lo[1] + c / width % box.size(1), box.lo[2] + c / layer};
      for (size_t axis = 0; axis < 3; ++axis)
        for (const int64_t step : {-1, 1}) {
          Cell next = cell;
          next[axis] += step;
          if (next[axis] < box.lo[axis] || next[axis] >= box.hi[axis]) continue;
          const size_t to = frame.offset(next[0], next[1], next[2]);
          if (inside[to] == 0 || sizes[to] != 0) continue;
          sizes[to] = 1;
          waiting.push_back(to);
        }
    }
    for (const size_t at : part) sizes[at] = static_cast<float>(part.size());
  }
  return sizes;
}

class PartSize final : public OneChannel<design::WholeStage> {
 public:
  explicit PartSize(const design::NodePtr& solid) : OneChannel(solid, {0, 1e9}) {}
  double bytes_of_cell() const override { return 4; }
  void compute(const StageValues& read, StageValues& made, const design::StageLattice&,
               const design::StageWork&) const override {
    made.channel(0) = sizes_of_parts(read.channel(0), read.box());
  }
};

class Stages : public testing::Test {
 protected:
  void SetUp() override {
    Diagnostics diagnostics;
    loaded_ = load_text(design_text, diagnostics);
    ASSERT_TRUE(loaded_) << to_text(diagnostics);
    lattice_.origin = {-8.03, -4.1, -4.2};
    lattice_.pitch = {Pitch{1, 10}, Pitch{1, 8}, Pitch{1, 5}};
    lattice_.count = {160, 80, 42};
  }

  const design::NodePtr& solid() const { return loaded_->design.parts[0].solid; }

  design::StagePlace place() const {
    return {loaded_->design.materials, lattice_.voxel_mm(), lattice_.voxel_mm(),
            design::StageLattice{lattice_.origin, lattice_.pitch}};
  }

  // Returns the values of all of the lattice's voxels, read in boxes of this size by `threads` threads.
  std::vector<float> values(JobStages& stages, const design::StagePtr& stage, const Cell& piece, int threads) const {
    const program::SourceField source = stages.source(stage, place());
    StageLoan loan;
    loan.threads = threads;
    loan.memory_bytes = memory_;
    loan.keeper = keeper_;
    loan.progress = progress_;
    stages.prepare(loan);
    const auto rows = source->rows(0, voxel::design_from_index(lattice_));
    EXPECT_TRUE(rows && rows->has_values());
    if (!rows || !rows->has_values()) return {};
    StageValues all({{0, 0, 0}, lattice_.count}, 1);
    Cell count;
    for (size_t a = 0; a < 3; ++a) count[a] = (lattice_.count[a] + piece[a] - 1) / piece[a];
    run_parallel(static_cast<size_t>(count[0] * count[1] * count[2]), threads, [&](size_t number) {
      // The last boxes come first, an order in which no job reads layers.
      const int64_t n = count[0] * count[1] * count[2] - 1 - static_cast<int64_t>(number);
      const Cell lo{n % count[0] * piece[0], n / count[0] % count[1] * piece[1], n / (count[0] * count[1]) * piece[2]};
      const IndexBox box = intersect({lo, {lo[0] + piece[0], lo[1] + piece[1], lo[2] + piece[2]}}, all.box());
      const Interval range = rows->range(box);
      for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
        for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
          const auto row =
              std::span(all.channel(0)).subspan(all.offset(box.lo[0], j, k), static_cast<size_t>(box.size(0)));
          rows->values(box.lo[0], j, k, row);
          for (const float v : row) EXPECT_TRUE(range.contains(v));
        }
    });
    return all.channel(0);
  }

  // Checks that all sizes of boxes and numbers of threads give the expected values.
  void expect_values(const design::StagePtr& stage, const std::vector<float>& expected) const {
    for (const int threads : {1, 3})
      for (const Cell& piece : {Cell{160, 80, 42}, Cell{160, 80, 5}, Cell{33, 17, 8}}) {
        const JobStagesPtr made = stages_of(design::Design());
        JobStages& stages = *made;
        ASSERT_EQ(values(stages, stage, piece, threads), expected);
      }
  }

  std::vector<float> over_voxels(const std::function<float(int64_t, int64_t, int64_t)>& value) const {
    std::vector<float> values;
    for (int64_t k = 0; k < lattice_.count[2]; ++k)
      for (int64_t j = 0; j < lattice_.count[1]; ++j)
        for (int64_t i = 0; i < lattice_.count[0]; ++i) values.push_back(value(i, j, k));
    return values;
  }
  bool is_inside(int64_t i, int64_t j, int64_t k) const { return is_in_balls(lattice_.center(i, j, k)); }

  std::vector<float> box_counts(const Cell& size) const {
    return over_voxels([&](int64_t i, int64_t j, int64_t k) {
      float sum = 0;
      for (int64_t z = 0; z < size[2]; ++z)
        for (int64_t y = 0; y < size[1]; ++y)
          for (int64_t x = 0; x < size[0]; ++x)
            sum += is_inside(i + x - size[0] / 2, j + y - size[1] / 2, k + z - size[2] / 2) ? 1.0f : 0.0f;
      return sum;
    });
  }

  LoadedPtr loaded_;
  voxel::Lattice lattice_;
  size_t memory_ = size_t{1} << 30;
  StageKeeper* keeper_ = nullptr;
  Progress* progress_ = nullptr;
};

class MapKeeper : public StageKeeper {
 public:
  std::optional<std::string> find(const Hash& made_from) override {
    const auto found = kept.find(made_from.hex());
    return found == kept.end() ? std::nullopt : std::optional(found->second);
  }
  void keep(const Hash& made_from, std::string values) override { kept[made_from.hex()] = std::move(values); }

  std::map<std::string, std::string> kept;
};

// Counts how often stages tell that they are computed.
class PreparationCounter : public Progress {
 public:
  void update(const HowFar&) override {}
  void preparing(const std::string&, const HowFar&) override { ++count; }

  int count = 0;
};

TEST_F(Stages, OfAHaloReadWhatIsAround) {
  for (const Cell& size : {Cell{3, 3, 3}, Cell{4, 1, 2}, Cell{1, 6, 5}})
    expect_values(std::make_shared<BoxCount>(solid(), size), box_counts(size));
}

TEST_F(Stages, OfAHaloGiveTheSameWhereBlocksAreDropped) {
  const Cell size{4, 3, 2};
  memory_ = 1;
  const JobStagesPtr made = stages_of(design::Design());
  JobStages& stages = *made;
  EXPECT_EQ(values(stages, std::make_shared<BoxCount>(solid(), size), {20, 10, 42}, 1), box_counts(size));
  EXPECT_GT(stages.block_counts().dropped, 0U);
}

TEST_F(Stages, ThatSweepKeepAStateForEachColumn) {
  std::vector<float> sums(static_cast<size_t>(lattice_.count[0] * lattice_.count[1]), 0.0f);
  std::vector<float> expected(static_cast<size_t>(lattice_.voxels()));
  for (int64_t k = lattice_.count[2]; k-- > 0;)
    for (int64_t j = 0; j < lattice_.count[1]; ++j)
      for (int64_t i = 0; i < lattice_.count[0]; ++i) {
        const auto column = static_cast<size_t>(j * lattice_.count[0] + i);
        if (is_inside(i, j, k)) ++sums[column];
        // A sweep ends at the layer in which the solid's bounds do.
        const double top = static_cast<double>(k + 1) * lattice_.pitch[2].mm() + lattice_.origin.z;
        expected[static_cast<size_t>(k) * sums.size() + column] = top > -3.7 ? sums[column] : 0;
      }
  expect_values(std::make_shared<SumFromTop>(solid()), expected);
}

TEST_F(Stages, OfTheWholeSeeAllCells) {
  const auto inside = over_voxels([&](int64_t i, int64_t j, int64_t k) { return is_inside(i, j, k) ? 1.0f : 0.0f; });
  const auto expected = sizes_of_parts(inside, {{0, 0, 0}, lattice_.count});
  // The test balls have as many cells as their volumes say, up to some of those at the surface.
  const double cell = 0.1 * 0.125 * 0.2, volume = 4.0 / 3 * 3.141592653589793 * 3.7 * 3.7 * 3.7;
  EXPECT_NEAR(*std::ranges::max_element(expected), volume / cell, 0.005 * volume / cell);
  expect_values(std::make_shared<PartSize>(solid()), expected);
}

TEST_F(Stages, ComputedAsAWholeAreTakenFromTheirKeeper) {
  for (const design::StagePtr& stage :
       std::vector<design::StagePtr>{std::make_shared<PartSize>(solid()), std::make_shared<SumFromTop>(solid())}) {
    MapKeeper keeper;
    PreparationCounter counter;
    keeper_ = &keeper;
    progress_ = &counter;
    const auto again = [&] {
      counter.count = 0;
      return values(*stages_of(design::Design()), stage, {160, 80, 42}, 2);
    };
    const std::vector<float> computed = again();
    EXPECT_GT(counter.count, 0);
    ASSERT_EQ(keeper.kept.size(), 1U);
    EXPECT_EQ(again(), computed);
    EXPECT_EQ(counter.count, 0);
    BytePacker empty;  // lists for a smaller lattice
    for (int list = 0; list < 2; ++list) empty.add_list(std::vector<float>{});
    keeper.kept.begin()->second = empty.take();
    EXPECT_EQ(again(), computed);
    EXPECT_GT(counter.count, 0);
  }
}

TEST_F(Stages, StandOnTheJobsLatticeAlsoWhereThePartIsMovedByWholeVoxels) {
  const auto stage = std::make_shared<BoxCount>(solid(), Cell{3, 3, 3});
  const JobStagesPtr made = stages_of(design::Design());
  JobStages& stages = *made;
  const program::SourceField source = stages.source(stage, place());
  Affine moved = voxel::design_from_index(lattice_);
  moved.offset = moved.offset + Vec3{0.7, -0.25, 0.4};
  EXPECT_TRUE(source->rows(0, moved));
  moved.offset.x += 0.03;
  EXPECT_FALSE(source->rows(0, moved));
}

TEST_F(Stages, AreLinearBetweenCentres) {
  const auto stage = std::make_shared<BoxCount>(solid(), Cell{3, 3, 3});
  const JobStagesPtr made = stages_of(design::Design());
  JobStages& stages = *made;
  const program::SourceField source = stages.source(stage, place());
  const Vec3 a = lattice_.center(70, 40, 21), b = lattice_.center(71, 40, 21);
  EXPECT_NEAR(source->sample(0, 0.75 * a + 0.25 * b), 0.75 * source->sample(0, a) + 0.25 * source->sample(0, b), 1e-9);
}

TEST_F(Stages, ThatNeedMoreMemoryThanThereIsDoNotBegin) {
  const JobStagesPtr made = stages_of(design::Design());
  JobStages& stages = *made;
  const auto kept = stages.source(std::make_shared<PartSize>(solid()), place());
  StageLoan loan;
  loan.memory_bytes = 1000;
  expect_error([&] { stages.prepare(loan); }, "more than the 1000 bytes allowed; allow more with --memory");
}

TEST_F(Stages, StopOnRequest) {
  const JobStagesPtr made = stages_of(design::Design());
  JobStages& stages = *made;
  const auto kept = stages.source(std::make_shared<SumFromTop>(solid()), place());
  StopFlag stop;
  stop.request();
  StageLoan loan;
  loan.stop = &stop;
  EXPECT_THROW(stages.prepare(loan), Cancelled);
  EXPECT_FALSE(stages.is_prepared());
}

// Blends over voxels.

std::vector<MaterialId> sliced(const std::string& text, int threads, size_t memory) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(text, diagnostics);
  PlanOptions options;
  options.threads = threads;
  options.memory_bytes = memory;
  const auto plan = loaded ? plan_slice(loaded, options, diagnostics) : std::nullopt;
  EXPECT_TRUE(plan) << to_text(diagnostics);
  return plan ? unpack(plan->producer(0, plan->request.lattice.count[2], nullptr)) : std::vector<MaterialId>();
}

// Two cubes of 32 voxels along x, the first red and the second blue.
const std::string step_text = "{ translate(-1.6, 0, 0) cube(3.2, \"red\"); translate(1.6, 0, 0) cube(3.2, \"blue\"); }";

// Returns the fractions of a material in a box of voxels, x fastest.
std::vector<float> fractions_in(const std::string& text, const std::string& material, const IndexBox& box) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(text, diagnostics);
  const auto plan = loaded ? plan_slice(loaded, {}, diagnostics) : std::nullopt;
  GridQuery query;
  query.fractions = true;
  const auto job = plan ? plan_grids(loaded, *plan, query, box, diagnostics) : std::nullopt;
  EXPECT_TRUE(job) << to_text(diagnostics);
  if (!job) return {};
  StageValues values(box, 1);
  for (size_t n = 0; n < job->grids.size(); ++n) {
    if (job->grids[n].name != material) continue;
    for (const voxel::FieldTile& tile : job->tiles(box, nullptr)) {
      const float* from = tile.output(n);
      for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
        for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j)
          for (int64_t i = tile.box.lo[0]; i < tile.box.hi[0]; ++i, from += tile.is_uniform ? 0 : 1)
            values.channel(0)[values.offset(i, j, k)] = *from;
    }
  }
  return values.channel(0);
}

// Returns the fractions of red along x in the middle.
std::vector<float> reds(const std::string& text) { return fractions_in(text, "red", {{0, 16, 16}, {64, 17, 17}}); }

TEST(Blend, OfAStepIsTheLinearRamp) {
  for (const int n : {2, 5, 10}) {
    const std::vector<float> red = reds("blend((" + std::to_string(n) + ", 1, 1)) union() " + step_text);
    ASSERT_EQ(red.size(), 64U);
    // The box of voxel i begins at i - floor(n / 2); at the ends of the design it has fewer voxels.
    for (int i = 0; i < 64; ++i) {
      const int begin = std::max(i - n / 2, 0), end = std::min(i - n / 2 + n, 64);
      const int in_red = std::clamp(32 - begin, 0, end - begin);
      ASSERT_EQ(red[static_cast<size_t>(i)], static_cast<float>(in_red) / static_cast<float>(end - begin)) << n << i;
    }
  }
}

TEST(Blend, CountsVoidOnRequest) {
  const std::vector<float> red = reds("blend((5, 1, 1), count_void=true) union() " + step_text);
  for (int i = 0; i < 64; ++i) {
    const int begin = i - 2, end = i + 3;
    const int in_red = std::clamp(std::min(32, end) - std::max(begin, 0), 0, 5);
    ASSERT_EQ(red[static_cast<size_t>(i)], static_cast<float>(in_red) / 5) << i;
  }
}

TEST(Blend, OfABlendIsOneAfterTheOther) {
  const std::vector<float> red = reds("blend((4, 1, 1)) blend((7, 1, 1)) union() " + step_text);
  const auto mean = [](const std::vector<double>& values, int n) {
    std::vector<double> means;
    for (int i = 0; i < 64; ++i) {
      const int begin = std::max(i - n / 2, 0), end = std::min(i - n / 2 + n, 64);
      double sum = 0;
      for (int at = begin; at < end; ++at) sum += values[static_cast<size_t>(at)];
      means.push_back(sum / (end - begin));
    }
    return means;
  };
  std::vector<double> expected(64, 0.0);
  std::fill_n(expected.begin(), 32, 1.0);
  expected = mean(mean(expected, 7), 4);
  for (size_t i = 0; i < 64; ++i) ASSERT_NEAR(red[i], expected[i], 1e-6) << i;
}

// Returns squares of 20 x 20 voxels around the origin.
std::string squares(const std::array<std::string, 4>& colours) {
  std::string text;
  for (size_t n = 0; n < 4; ++n)
    text += "translate(" + std::string(n % 2 == 0 ? "-1" : "1") + (n < 2 ? ", -1" : ", 1") +
            ", 0) rectprism((2, 2, 0.3), \"" + colours[n] + "\"); ";
  return "union() { " + text + "}";
}

// Figure 8 of the paper of 2023: the convolution of four squares is the product of two ramps.
TEST(Blend, OfFourSquaresIsTheirConvolution) {
  const std::string text = "blend((10, 10, 1)) " + squares({"red", "blue", "green", "yellow"});
  const auto red = fractions_in(text, "red", {{0, 0, 1}, {40, 40, 2}});
  const auto share = [](int i) {
    const int begin = std::max(i - 5, 0), end = std::min(i + 5, 40);
    return static_cast<double>(std::clamp(20 - begin, 0, end - begin)) / (end - begin);
  };
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 40; ++i) ASSERT_NEAR(red[static_cast<size_t>(40 * j + i)], share(i) * share(j), 1e-7) << i << j;
}

// Figure 9: of nine voxels five are of one material, and four of the other.
TEST(Blend, GivesTheSharesOfThePaper) {
  const std::string text = "blend((3, 3, 1)) " + squares({"red", "red", "red", "blue"});
  EXPECT_EQ(fractions_in(text, "red", {{20, 20, 1}, {21, 21, 2}})[0], 5.0f / 9);
  EXPECT_EQ(fractions_in(text, "blue", {{20, 20, 1}, {21, 21, 2}})[0], 4.0f / 9);
}

TEST(Blend, IsTheSameInPiecesAndOnAnyNumberOfThreads) {
  const std::string text = "blend((9, 6, 3)) union() " + step_text;
  const auto whole = sliced(text, 1, size_t{1} << 30);
  EXPECT_EQ(sliced(text, 2, 1), whole);
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(text, diagnostics);
  const auto plan = plan_slice(loaded, {}, diagnostics);
  ASSERT_TRUE(plan);
  const auto& count = plan->request.lattice.count;
  for (int64_t k = 0; k < count[2]; k += 11) {
    const IndexBox box{{7, 3, k}, {53, 29, k + 1}};
    const auto part = unpack(plan->regions(box, nullptr));
    size_t n = 0;
    for (int64_t j = 3; j < 29; ++j)
      for (int64_t i = 7; i < 53; ++i, ++n)
        ASSERT_EQ(part[n], whole[static_cast<size_t>((k * count[1] + j) * count[0] + i)]);
  }
}

TEST(Blend, KeepsTheShape) {
  const auto plain = sliced("union() " + step_text, 1, size_t{1} << 30);
  const auto blended = sliced("blend((9, 6, 3)) union() " + step_text, 1, size_t{1} << 30);
  ASSERT_EQ(plain.size(), blended.size());
  for (size_t n = 0; n < plain.size(); ++n) ASSERT_EQ(plain[n] != 0, blended[n] != 0);
}

}  // namespace
}  // namespace ombre::compile
