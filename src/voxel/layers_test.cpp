// All evaluators and options must give the same voxels.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/text/error.h"
#include "program/field.h"
#include "program/program_text.h"
#include "voxel/layers.h"

namespace ombre::voxel {
namespace {

using program::Builder;
using program::Field;
using program::Op;

constexpr Op all_ops[] = {
#define OMBRE_ROW(name, arity) Op::name,
    OMBRE_OPS(OMBRE_ROW)
#undef OMBRE_ROW
};

Lattice lattice_of(int64_t width, int64_t height, int64_t layers) {
  const auto tenth = Pitch::parse("0.1").value();
  return {{-0.05 * static_cast<double>(width) + 0.013, -0.05 * static_cast<double>(height) + 0.007, -0.3},
          {tenth, tenth, tenth},
          {width, height, layers}};
}

// Returns a solid of four materials with a check, made of random ops and cut by a ball, so that all kinds of tiles
// occur.
MaterialProgram random_solid(std::mt19937& random) {
  Builder b;
  std::vector<Field> fields{b.input(0), b.input(1), b.input(2), b.constant(0.5), b.constant(-2), b.constant(3)};
  const auto any = [&] { return fields[random() % fields.size()]; };
  for (int n = 0; n < 30; ++n) fields.push_back(b.apply(all_ops[random() % std::size(all_ops)], any(), any(), any()));
  const auto made = [&] { return fields[6 + random() % (fields.size() - 6)]; };
  const Field ball = length(b.input(0), b.input(1), b.input(2)) - 4.0;
  std::vector<std::pair<std::string, Field>> outputs{
      {"inside", random() % 2 ? max(ball, made()) <= 0 : min(ball + 2.0, made()) <= 0}};
  for (int m = 0; m < 4; ++m) outputs.emplace_back("m", made());
  outputs.emplace_back("check", truth(made()));
  return {b.finish(outputs), {1, 2, 5, 0}, 1};
}

struct Result {
  std::vector<MaterialId> ids;
  std::vector<CheckHits> checks;
};

Result evaluate(const MaterialProgram& program, const Lattice& lattice, const EvaluatorOptions& options, int64_t slab,
                Dither dither = Dither::stochastic) {
  const LayerEvaluator evaluator(program, lattice, dither, 7, options);
  Result result;
  for (int64_t k = 0; k < lattice.count[2]; k += slab) {
    for (const LayerResult& layer : evaluator.layers(k, std::min(k + slab, lattice.count[2]))) {
      for (uint32_t j = 0; j < layer.materials().height(); ++j) {
        result.ids.resize(result.ids.size() + layer.materials().width());
        layer.materials().row(j).unpack(result.ids.data() + result.ids.size() - layer.materials().width());
      }
      result.checks.insert(result.checks.end(), layer.checks.begin(), layer.checks.end());
    }
  }
  return result;
}

void expect_same(const Result& a, const Result& b, const std::string& how, const MaterialProgram& program) {
  ASSERT_EQ(a.ids.size(), b.ids.size());
  size_t different = 0;
  for (size_t n = 0; n < a.ids.size(); ++n) different += a.ids[n] != b.ids[n];
  EXPECT_EQ(different, 0u) << how << "\n" << to_text(program.program);
  for (size_t n = 0; n < a.checks.size(); ++n) {
    EXPECT_EQ(a.checks[n].count, b.checks[n].count) << how;
    if (a.checks[n].count == 0) continue;
    EXPECT_EQ(a.checks[n].first, b.checks[n].first) << how;
  }
}

}  // namespace

TEST(Layers, AreTheSameWhateverWayTheyAreEvaluated) {
  if (instruction_sets().empty()) GTEST_SKIP() << "no hardware multiply-add";
  std::mt19937 random(1);
  for (int n = 0; n < 60; ++n) {
    const MaterialProgram program = random_solid(random);
    const Lattice lattice = lattice_of(150 + static_cast<int64_t>(random() % 200), 100, 10);
    const Dither dither = static_cast<Dither>(n % 4);
    EvaluatorOptions plain;
    const Result expected = evaluate(program, lattice, plain, 8, dither);
    for (const std::string& set : instruction_sets()) {
      EvaluatorOptions options;
      options.instruction_set = set;
      expect_same(evaluate(program, lattice, options, 8, dither), expected, set, program);
      options.prune = false;
      expect_same(evaluate(program, lattice, options, 10, dither), expected, set + ", without pruning", program);
    }
    for (const int64_t width : {16, 48, 512}) {
      EvaluatorOptions options;
      options.leaf_width = width;
      expect_same(evaluate(program, lattice, options, 3, dither), expected, "tiles of " + std::to_string(width),
                  program);
    }
    expect_same(evaluate(program, lattice, plain, 1, dither), expected, "single layers", program);
    if (testing::Test::HasFailure()) return;
  }
}

// Random programs have jumps and overflow, but nearly all voxels must agree.
TEST(Layers, BatchesFollowTheReference) {
  if (instruction_sets().empty()) GTEST_SKIP() << "no hardware multiply-add";
  std::mt19937 random(2);
  size_t different = 0, inside = 0, voxels = 0;
  for (int n = 0; n < 60; ++n) {
    const MaterialProgram program = random_solid(random);
    const Lattice lattice = lattice_of(140, 100, 4);
    EvaluatorOptions reference;
    reference.evaluator = Evaluator::reference;
    const Result exact = evaluate(program, lattice, reference, 4), fast = evaluate(program, lattice, {}, 4);
    size_t here = 0;
    for (size_t v = 0; v < exact.ids.size(); ++v) {
      here += exact.ids[v] != fast.ids[v];
      inside += exact.ids[v] != 0;
    }
    EXPECT_LT(static_cast<double>(here), 0.01 * static_cast<double>(exact.ids.size())) << to_text(program.program);
    different += here;
    voxels += exact.ids.size();
  }
  EXPECT_LT(static_cast<double>(different), 1e-3 * static_cast<double>(voxels));
  EXPECT_GT(static_cast<double>(inside), 0.1 * static_cast<double>(voxels));
  RecordProperty("different_voxels_per_million",
                 static_cast<int>(1e6 * static_cast<double>(different) / static_cast<double>(voxels)));
}

TEST(Layers, StopBetweenStrips) {
  Builder b;
  const MaterialProgram ball{
      b.finish({{"inside", length(b.input(0), b.input(1), b.input(2)) <= 4.0}, {"m", b.constant(1)}}), {1}, 0};
  const LayerEvaluator evaluator(ball, lattice_of(80, 80, 6), Dither::stochastic, 7);
  StopFlag stop;
  EXPECT_EQ(evaluator.layers(0, 6, &stop).size(), 6U);
  stop.request();
  EXPECT_THROW(evaluator.layers(0, 6, &stop), Cancelled);
}

// Any box of the lattice has the same voxels as the whole layers, whatever its position among their tiles.
TEST(Layers, RegionsAreCutFromTheWhole) {
  std::mt19937 random(11);
  Lattice lattice;
  lattice.origin = {-5, -5, -5};
  lattice.pitch.fill(Pitch{1, 16});
  lattice.count = {160, 150, 12};
  for (int round = 0; round < 12; ++round) {
    const MaterialProgram program = random_solid(random);
    for (const Dither dither : {Dither::stochastic, Dither::blue_noise, Dither::threshold, Dither::diffusion}) {
      const LayerEvaluator evaluator(program, lattice, dither, 7);
      const std::vector<LayerResult> whole = evaluator.layers(0, 12);
      TileBox box;
      for (size_t axis = 0; axis < 3; ++axis) {
        box.lo[axis] = static_cast<int64_t>(random() % static_cast<uint32_t>(lattice.count[axis]));
        box.hi[axis] = box.lo[axis] + 1 +
                       static_cast<int64_t>(random() % static_cast<uint32_t>(lattice.count[axis] - box.lo[axis]));
      }
      const std::vector<LayerResult> part = evaluator.region(box);
      ASSERT_EQ(static_cast<int64_t>(part.size()), box.size(2));
      std::vector<MaterialId> row(160), of_part(static_cast<size_t>(box.size(0)));
      for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
        for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
          whole[static_cast<size_t>(k)].materials().row(static_cast<uint32_t>(j)).unpack(row.data());
          part[static_cast<size_t>(k - box.lo[2])]
              .materials()
              .row(static_cast<uint32_t>(j - box.lo[1]))
              .unpack(of_part.data());
          ASSERT_TRUE(std::equal(of_part.begin(), of_part.end(), row.begin() + box.lo[0]))
              << name(dither) << ' ' << j << ' ' << k;
        }
    }
  }
}

}  // namespace ombre::voxel
