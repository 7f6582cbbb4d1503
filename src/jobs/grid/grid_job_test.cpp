// Tests grids for other programs against mathematics, slices and the reference.
#include "jobs/grid/grid_job.h"

#include <cmath>

#include "base/system/test_source_files.h"
#include "base/text/error.h"
#include "formats/containers/file.h"
#include "jobs/grid/volume_files.h"
#include "jobs/slice/plan_part.h"
#include "jobs/test_designs.h"

namespace ombre::compile {
namespace {

// All values of a job's grids: of grid n at voxel (i, j, k) of the lattice.
struct Sampled {
  GridJob job;
  std::vector<std::vector<float>> values;

  float at(size_t grid, int64_t i, int64_t j, int64_t k) const {
    const auto& box = job.region;
    return values[grid]
                 [static_cast<size_t>(((k - box.lo[2]) * box.size(1) + j - box.lo[1]) * box.size(0) + i - box.lo[0])];
  }
};

void copy(const voxel::FieldTile& tile, Sampled& sampled) {
  const auto& box = sampled.job.region;
  for (size_t n = 0; n < sampled.values.size(); ++n) {
    const float* from = tile.output(n);
    for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
      for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j)
        for (int64_t i = tile.box.lo[0]; i < tile.box.hi[0]; ++i) {
          const auto at = ((k - box.lo[2]) * box.size(1) + j - box.lo[1]) * box.size(0) + i - box.lo[0];
          sampled.values[n][static_cast<size_t>(at)] = *from;
          if (!tile.is_uniform) ++from;
        }
  }
}

struct GridCase {
  GridQuery query;
  PlanOptions options;
  std::optional<Box> box;
  int threads = 2;
};

std::optional<GridJob> plan_text(const std::string& text, const GridCase& grid_case) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(text, diagnostics);
  const auto plan = loaded ? plan_slice(loaded, grid_case.options, diagnostics) : std::nullopt;
  EXPECT_TRUE(plan) << to_text(diagnostics);
  if (!plan) return std::nullopt;
  voxel::TileBox region{{0, 0, 0}, plan->request.lattice.count};
  if (grid_case.box) region = region_over(plan->request.lattice, *grid_case.box).value();
  return plan_grids(loaded, *plan, grid_case.query, region, diagnostics);
}

Sampled sample(const std::string& text, const GridCase& grid_case) {
  Sampled sampled{plan_text(text, grid_case).value(), {}};
  const auto voxels = static_cast<size_t>(sampled.job.region.voxels());
  sampled.values.assign(sampled.job.grids.size(), std::vector<float>(voxels, std::nanf("")));
  each_slab(
      sampled.job, grid_case.threads,
      [&](const GridSlab& slab) {
        for (const voxel::FieldTile& tile : slab.tiles) copy(tile, sampled);
      },
      nullptr, nullptr);
  return sampled;
}

GridQuery materials() { return {true, false, false, false}; }
GridQuery fractions() { return {false, true, false, false}; }
GridQuery distance() { return {false, false, true, false}; }
PlanOptions pitch(double mm) {
  PlanOptions options;
  options.pitch = {Pitch::from_mm(mm), Pitch::from_mm(mm), Pitch::from_mm(mm)};
  return options;
}

const std::string graded =
    "fgrade([\"0.5 + x/10 + 0*d\", \"0.3 - x/10\", \"0.2\"], [\"red\", \"blue\", \"green\"]) { difference() { "
    "sphere(4); "
    "rotate(20, 30, 40) { cylinder(1, 9); } } }";

std::string temporary(const std::string& name) { return testing::TempDir() + std::to_string(getpid()) + "_" + name; }

// The attribute of a ball of 3 mm: 2 + z inside, 7 elsewhere.
const std::string dosed =
    "attribute(\"dose\", \"2 + z\", unit=\"J/cm2\", default=7) { sphere(3, \"red\"); }"
    "attribute(\"heat\", 5) { translate(10, 0, 0) { sphere(1); } }";

GridQuery named(std::vector<std::string> names) {
  GridQuery query;
  query.attributes = std::move(names);
  return query;
}

}  // namespace

TEST(Grids, MaterialsAreWhatSlicingWrites) {
  for (const auto dither : {voxel::Dither::stochastic, voxel::Dither::diffusion}) {
    PlanOptions options = pitch(0.15);
    options.dither = dither;
    options.seed = 3;
    const Sampled grid = sample(graded, {materials(), options, std::nullopt, 3});
    const Voxels slices = slice_text(graded, options);
    ASSERT_EQ(grid.values[0].size(), slices.ids.size());
    for (size_t n = 0; n < slices.ids.size(); ++n) ASSERT_EQ(grid.values[0][n], static_cast<float>(slices.ids[n])) << n;
  }
}

TEST(Grids, DistanceOfASphereIsExact) {
  for (const auto evaluator : {voxel::Evaluator::batch, voxel::Evaluator::reference}) {
    PlanOptions options = pitch(0.21);
    options.evaluator = evaluator;
    const Sampled grid =
        sample("root((-6, -5, -7), (6, 7, 5), (0.21, 0.21, 0.21)) { sphere(4); }", {distance(), options, {}, 2});
    const voxel::Lattice& lattice = grid.job.request.lattice;
    EXPECT_EQ(grid.job.metric, design::Metric::exact());
    for (int64_t k = 0; k < lattice.count[2]; ++k)
      for (int64_t j = 0; j < lattice.count[1]; ++j)
        for (int64_t i = 0; i < lattice.count[0]; ++i)
          ASSERT_NEAR(grid.at(0, i, j, k), length(lattice.center(i, j, k)) - 4, 2e-6) << i << " " << j << " " << k;
  }
}

TEST(Grids, NarrowBandsAreCutOff) {
  const Sampled grid = sample("sphere(4);", {{false, false, true, true}, pitch(0.25), {}, 2});
  EXPECT_EQ(grid.job.band_mm, 0.75);
  const voxel::Lattice& lattice = grid.job.request.lattice;
  const voxel::TileBox& region = grid.job.region;
  EXPECT_EQ(region.lo[2], -4);  // the band goes on outside
  EXPECT_EQ(region.hi[2], lattice.count[2] + 4);
  for (int64_t k = region.lo[2]; k < region.hi[2]; ++k)
    for (int64_t i = region.lo[0]; i < region.hi[0]; ++i)
      ASSERT_NEAR(grid.at(0, i, 9, k), std::clamp(length(lattice.center(i, 9, k)) - 4, -0.75, 0.75), 2e-6);
}

// The mesh lies on the border of the lattice.
TEST(Grids, BandsOfMeshesHaveNothingInsideBeyondTheLattice) {
  const Sampled grid = sample("mesh(\"" + source_file("examples/models/tetrahedron.off") + "\");",
                              {{false, true, true, true}, pitch(0.3), {}, 2});
  const voxel::TileBox& region = grid.job.region;
  const auto& count = grid.job.request.lattice.count;
  for (int64_t k = region.lo[2]; k < region.hi[2]; ++k)
    for (int64_t j = region.lo[1]; j < region.hi[1]; ++j)
      for (int64_t i = region.lo[0]; i < region.hi[0]; ++i) {
        const bool beyond = i < 0 || j < 0 || k < 0 || i >= count[0] || j >= count[1] || k >= count[2];
        ASSERT_TRUE(!beyond || (grid.at(0, i, j, k) > 0 && grid.at(1, i, j, k) == 0)) << i << " " << j << " " << k;
      }
}

TEST(Grids, FractionsSumToOneInsideAndAreNothingOutside) {
  const Sampled grid = sample(graded, {fractions(), pitch(0.13), {}, 2});
  const Sampled ids = sample(graded, {materials(), pitch(0.13), {}, 2});
  ASSERT_EQ(grid.job.grids.size(), 3u);
  for (size_t n = 0; n < ids.values[0].size(); ++n) {
    float sum = 0;
    for (const auto& values : grid.values) {
      EXPECT_GE(values[n], 0);
      sum += values[n];
    }
    ASSERT_NEAR(sum, ids.values[0][n] != 0 ? 1 : 0, 1e-6) << n;
  }
}

TEST(Grids, FractionsFollowTheGrade) {
  const Sampled grid = sample(graded, {fractions(), pitch(0.2), {}, 2});
  const voxel::Lattice& lattice = grid.job.request.lattice;
  for (size_t g = 0; g < 3; ++g) {
    const std::string& name = grid.job.grids[g].name;
    for (int64_t i = 0; i < lattice.count[0]; ++i) {
      const double x = lattice.center(i, 0, 0).x;
      const double red = std::max(0.0, 0.5 + x / 10), blue = std::max(0.0, 0.3 - x / 10), total = red + blue + 0.2;
      const double expected = (name == "red" ? red : name == "blue" ? blue : 0.2) / total;
      const float found = grid.at(g, i, lattice.count[1] / 2 + 9, lattice.count[2] / 2);
      EXPECT_TRUE(found == 0 || std::abs(found - expected) < 1e-6) << name << " at " << x;
    }
  }
}

TEST(Grids, ABoxIsCutFromTheWhole) {
  const Box box{{-1.03, 0.5, -2}, {2.2, 3.1, 1.77}};
  for (const GridQuery& query : {materials(), fractions(), distance()}) {
    const Sampled whole = sample(graded, {query, pitch(0.17), {}, 2});
    const Sampled part = sample(graded, {query, pitch(0.17), box, 1});
    const voxel::TileBox& region = part.job.region;
    EXPECT_GT(region.lo[0], 0);
    for (size_t g = 0; g < part.values.size(); ++g)
      for (int64_t k = region.lo[2]; k < region.hi[2]; ++k)
        for (int64_t j = region.lo[1]; j < region.hi[1]; ++j)
          for (int64_t i = region.lo[0]; i < region.hi[0]; ++i)
            ASSERT_EQ(part.at(g, i, j, k), whole.at(g, i, j, k)) << i << " " << j << " " << k;
  }
}

TEST(Grids, BatchesAgreeWithTheReference) {
  const std::string mesh = "mesh(\"" + source_file("examples/models/tetrahedron.off") + "\");";
  std::string struts = "union() {";
  for (int n = 0; n < 40; ++n)
    struts +=
        "strut((" + std::to_string(n % 8) + ", 0, 0), (0, " + std::to_string(n / 8) + ", 3), 0.2, caps=\"round\");";
  for (const std::string& body : {graded, mesh, struts + "}"}) {
    GridQuery both{false, true, true, false};
    PlanOptions exact = pitch(0.31);
    exact.evaluator = voxel::Evaluator::reference;
    const Sampled fast = sample(body, {both, pitch(0.31), {}, 2}), slow = sample(body, {both, exact, {}, 2});
    for (size_t n = 0; n < fast.values[0].size(); ++n) ASSERT_NEAR(fast.values[0][n], slow.values[0][n], 1e-4) << body;
    for (size_t g = 1; g < fast.values.size(); ++g) {
      size_t different = 0;
      for (size_t n = 0; n < fast.values[g].size(); ++n)
        different += std::abs(fast.values[g][n] - slow.values[g][n]) > 1e-4;
      EXPECT_LE(static_cast<double>(different), 3e-5 * static_cast<double>(fast.values[g].size()) + 1) << body;
    }
  }
}

// 1e30 squared does not fit into a float.
TEST(Grids, WhatFloatsCannotHoldIsComputedInDoubles) {
  const Sampled grid = sample("fgrade([\"(1e30 + x)^2 / 1e60\", \"1\"], [\"red\", \"blue\"]) { sphere(2); }",
                              {fractions(), pitch(0.25), {}, 1});
  for (const float value : grid.values[0]) ASSERT_TRUE(value == 0 || std::abs(value - 0.5) < 1e-6) << value;
}

TEST(Grids, FilesAreTheSameOnAnyNumberOfThreads) {
  for (const DenseFormat& format :
       {DenseFormat{&exporting::volume_format(".raw")}, DenseFormat{&exporting::volume_format(".npy")},
        DenseFormat{&exporting::volume_format(".nrrd")}, DenseFormat{&exporting::volume_format(".nrrd"), true}}) {
    const GridJob job = plan_text(graded, {{false, true, true, false}, pitch(0.12), {}, 1}).value();
    const auto paths = volume_paths(temporary("part.grid"), job.grids);
    ASSERT_EQ(paths.size(), 4u);
    std::vector<std::string> first;
    for (const int threads : {1, 2, 5}) {
      const GridReport report = write_volumes(job, paths, format, threads);
      EXPECT_TRUE(report.has_inside);
      std::vector<std::string> bytes;
      for (const std::string& path : paths) bytes.push_back(formats::read_file(path));
      if (first.empty()) first = bytes;
      EXPECT_TRUE(bytes == first) << threads;
    }
    for (const std::string& path : paths) std::remove(path.c_str());
    for (const std::string& path : paths) std::remove(exporting::description_path(path).c_str());
  }
}

TEST(Grids, NothingIsLeftOfWhatWasStopped) {
  const GridJob job = plan_text(graded, {materials(), pitch(0.1), {}, 1}).value();
  const std::string path = temporary("stopped.raw");
  StopFlag stop;
  stop.request();
  EXPECT_THROW(write_volumes(job, {path}, DenseFormat{&exporting::volume_format(".raw")}, 2, nullptr, &stop),
               Cancelled);
  for (const char* ending : {"", ".part", ".json", ".json.part"})
    EXPECT_THROW(formats::read_file(path + ending), Error);
}

TEST(Grids, NamesOfFilesSayTheGrid) {
  const Grid ids{GridKind::material, "material", std::nullopt}, far{GridKind::distance, "distance", std::nullopt};
  const Grid red{GridKind::fraction, "Red ink", SliceMaterial{}};
  EXPECT_EQ(volume_paths("out/part.npy", {ids}), std::vector<std::string>{"out/part.npy"});
  EXPECT_EQ(volume_paths("out/part.npy", {far}), std::vector<std::string>{"out/part.npy"});
  EXPECT_EQ(volume_paths("part.npy", {far, red})[0], "part_distance.npy");
  EXPECT_EQ(volume_paths("part.npy", {red}).size(), 1u);
  EXPECT_NE(volume_paths("part.npy", {red})[0], "part.npy");
}

TEST(Grids, AttributesHaveTheirDefaultOutside) {
  const Sampled grid = sample(dosed, {named({"dose"}), pitch(0.5), {}, 2});
  ASSERT_EQ(grid.job.grids.size(), 1u);
  EXPECT_EQ(grid.job.grids[0].attribute.unit, "J/cm2");
  const voxel::TileBox& region = grid.job.region;
  for (int64_t k = region.lo[2]; k < region.hi[2]; ++k)
    for (int64_t j = region.lo[1]; j < region.hi[1]; ++j)
      for (int64_t i = region.lo[0]; i < region.hi[0]; ++i) {
        const Vec3 p = grid.job.request.lattice.center(i, j, k);
        const double expected = length(p) <= 3 ? 2 + p.z : 7;
        const bool is_at_border = std::abs(length(p) - 3) < 1e-6 || length(p - Vec3{10, 0, 0}) < 1 + 1e-6;
        if (is_at_border) continue;
        ASSERT_NEAR(grid.at(0, i, j, k), expected, 1e-6) << p.x << ' ' << p.y << ' ' << p.z;
      }
}

TEST(Grids, AllAttributesComeBesideOtherGrids) {
  GridQuery query = fractions();
  query.all_attributes = true;
  const Sampled grid = sample(dosed, {query, pitch(0.5), {}, 2});
  std::vector<std::string> names;
  for (const Grid& g : grid.job.grids) names.push_back(g.name);
  EXPECT_EQ(std::ranges::count(names, "dose"), 1);
  EXPECT_EQ(std::ranges::count(names, "heat"), 1);
  EXPECT_FALSE(grid.job.has_inside_flag);
}

TEST(Grids, AttributesAloneKnowWhatIsInside) {
  const Sampled grid = sample(dosed, {named({"heat"}), pitch(0.5), {}, 1});
  EXPECT_TRUE(grid.job.has_inside_flag);
  const auto has_some = [&](const voxel::TileBox& region) {
    const auto tiles = grid.job.tiles(region, nullptr);
    return std::ranges::any_of(tiles, [&](const voxel::FieldTile& tile) { return has_inside(grid.job, tile); });
  };
  EXPECT_TRUE(has_some(grid.job.region));
  EXPECT_FALSE(has_some({{0, 0, 0}, {2, 2, 2}}));  // a corner of the box around the ball
}

TEST(Grids, UnknownAttributesAreAnError) {
  Diagnostics diagnostics;
  const auto loaded = load_text(dosed, diagnostics);
  const auto plan = plan_slice(loaded, pitch(0.5), diagnostics);
  ASSERT_TRUE(plan);
  EXPECT_FALSE(plan_grids(loaded, *plan, named({"dosee"}), {{0, 0, 0}, plan->request.lattice.count}, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("the design has no attribute \"dosee\"; did you mean \"dose\"?"),
            std::string::npos)
      << to_text(diagnostics);
}

}  // namespace ombre::compile
