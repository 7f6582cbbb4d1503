#include "fea/solve/homogenise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fea/model/test_models.h"
#include "fea/solve/homogenise_conductivity.h"

namespace ombre::fea {
namespace {

using namespace test;

// Returns a periodic block; a rule gives each cell its section, or none.
Model periodic(Cell count, const std::vector<Section>& sections, const std::function<int(Cell)>& section_at,
               Vec3 size_mm = {1, 1, 1}) {
  std::vector<Cell> cells;
  std::vector<uint16_t> of;
  for (int32_t k = 0; k < count[2]; ++k)
    for (int32_t j = 0; j < count[1]; ++j)
      for (int32_t i = 0; i < count[0]; ++i) {
        const int section = section_at({i, j, k});
        if (section < 0) continue;
        cells.push_back({i, j, k});
        of.push_back(static_cast<uint16_t>(section));
      }
  return {make_bricks({}, size_mm, std::move(cells), count), sections, std::move(of), {}};
}

struct Lame {
  double lambda, mu;
  explicit Lame(const Elastic& e)
      : lambda(e.modulus_mpa * e.poissons_ratio / ((1 + e.poissons_ratio) * (1 - 2 * e.poissons_ratio))),
        mu(e.modulus_mpa / (2 * (1 + e.poissons_ratio))) {}
  double bulk() const { return lambda + 2 * mu / 3; }
};

TEST(Homogenise, OneMaterialIsItself) {
  const Elastic elastic{2850, 0.39, 0};
  const Lame lame(elastic);
  const Homogenised found = homogenise(periodic({4, 5, 6}, {{"a", elastic}}, [](Cell) { return 0; }, {1, 2, 0.5}), {});
  EXPECT_EQ(found.solid_share, 1);
  for (size_t i = 0; i < 6; ++i)
    for (size_t j = 0; j < 6; ++j) {
      const double wanted = (i < 3 && j < 3 ? lame.lambda : 0) + (i == j ? (i < 3 ? 2 : 1) * lame.mu : 0);
      EXPECT_NEAR(found.stiffness_mpa[i][j], wanted, 1e-3) << i << ' ' << j;
      EXPECT_NEAR(found.reuss_mpa[i][j], wanted, 1e-3);
    }
  const auto constants = constants_of(found.stiffness_mpa);
  ASSERT_TRUE(constants);
  EXPECT_NEAR(constants->modulus_mpa[1], 2850, 1e-3);
  EXPECT_NEAR(constants->poissons_ratio[2], 0.39, 1e-6);
  EXPECT_NEAR(constants->shear_modulus_mpa[0], lame.mu, 1e-3);
  EXPECT_NEAR(constants->bulk_modulus_mpa, lame.bulk(), 1e-2);
  EXPECT_NEAR(constants->universal_anisotropy, 0, 1e-6);
  EXPECT_NEAR(modulus_along(found.stiffness_mpa, {1, 2, -3}), 2850, 1e-2);
}

// Returns the sections of a ball, 0, in the middle of n^3 bricks, and around it, 1, which it counts.
std::function<int(Cell)> around_ball(int32_t n, double radius, int32_t& outside) {
  return [=, &outside](Cell c) {
    double squares = 0;
    for (const int32_t along : c) squares += (along + 0.5 - n / 2.0) * (along + 0.5 - n / 2.0);
    if (squares <= radius * radius) return 0;
    ++outside;
    return 1;
  };
}

// For layers across z (Backus, 1962) stresses along z and strains in the plane are uniform.
TEST(Homogenise, LayersAreExact) {
  const Elastic stiff{2850, 0.39, 0}, soft{10, 0.2, 0};
  const auto is_stiff = [](Cell cell) { return cell[2] < 2; };  // 2 of 8 layers
  const Homogenised found = homogenise(
      periodic({6, 6, 8}, {{"a", stiff}, {"b", soft}}, [&](Cell c) { return is_stiff(c) ? 0 : 1; }), {1e-10});
  const Lame a(stiff), b(soft);
  const auto mean = [&](const std::function<double(const Lame&)>& of) { return 0.25 * of(a) + 0.75 * of(b); };
  const auto m = [](const Lame& x) { return x.lambda + 2 * x.mu; };
  const double c33 = 1 / mean([&](const Lame& x) { return 1 / m(x); });
  const double share = mean([&](const Lame& x) { return x.lambda / m(x); });
  const double c13 = share * c33;
  const double c11 = mean([&](const Lame& x) { return 4 * x.mu * (x.lambda + x.mu) / m(x); }) + share * share * c33;
  const double c44 = 1 / mean([](const Lame&x) { return 1 / x.mu; }), c66 = mean([](const Lame&x) { return x.mu; });
  const Stiffness& c = found.stiffness_mpa;
  EXPECT_NEAR(c[2][2], c33, 1e-4 * c33);
  EXPECT_NEAR(c[0][2], c13, 1e-4 * c13);
  EXPECT_NEAR(c[0][0], c11, 1e-5 * c11);
  EXPECT_NEAR(c[1][1], c11, 1e-5 * c11);
  EXPECT_NEAR(c[0][1], c11 - 2 * c66, 1e-5 * c11);
  EXPECT_NEAR(c[3][3], c66, 1e-5 * c66);
  EXPECT_NEAR(c[4][4], c44, 1e-4 * c44);
  EXPECT_NEAR(c[5][5], c44, 1e-4 * c44);
  EXPECT_NEAR(c[0][3], 0, 1e-5 * c11);
}

// The bulk modulus of stiff balls in a softer matrix lies between the bounds of Hashin and Shtrikman (1963), as do the
// means of the shear moduli.
TEST(Homogenise, BallsLieBetweenTheBoundsOfHashinAndShtrikman) {
  const Elastic ball{1000, 0.3, 0}, matrix{100, 0.3, 0};
  constexpr int32_t n = 16;
  int32_t outside = 0;
  const Homogenised found =
      homogenise(periodic({n, n, n}, {{"ball", ball}, {"matrix", matrix}}, around_ball(n, 6, outside)), {1e-7});
  const Lame i(ball), m(matrix);
  const double f = 1 - outside / static_cast<double>(n * n * n);
  const auto bulk_bound = [](const Lame& one, const Lame& other, double share) {
    return one.bulk() + share / (1 / (other.bulk() - one.bulk()) + 3 * (1 - share) / (3 * one.bulk() + 4 * one.mu));
  };
  const auto shear_bound = [](const Lame& one, const Lame& other, double share) {
    return one.mu + share / (1 / (other.mu - one.mu) + 6 * (1 - share) * (one.bulk() + 2 * one.mu) /
                                                           (5 * one.mu * (3 * one.bulk() + 4 * one.mu)));
  };
  const auto constants = constants_of(found.stiffness_mpa);
  ASSERT_TRUE(constants);
  EXPECT_GT(constants->bulk_modulus_mpa, bulk_bound(m, i, f));
  EXPECT_LT(constants->bulk_modulus_mpa, bulk_bound(i, m, 1 - f));
  EXPECT_GT(constants->mean_shear_modulus_mpa, shear_bound(m, i, f) * (1 - 1e-6));
  EXPECT_LT(constants->mean_shear_modulus_mpa, shear_bound(i, m, 1 - f));
  // The cell is cubic.
  EXPECT_NEAR(found.stiffness_mpa[0][0], found.stiffness_mpa[2][2], 1e-3);
  EXPECT_GT(constants->universal_anisotropy, 0);
}

// Columns along z are not connected: they carry load along z, and none across.
TEST(Homogenise, VoidBearsNothing) {
  const Elastic elastic{100, 0, 0};
  const Homogenised found =
      homogenise(periodic({4, 4, 4}, {{"a", elastic}}, [](Cell c) { return c[0] < 2 && c[1] < 2 ? 0 : -1; }), {});
  EXPECT_EQ(found.solid_share, 0.25);
  EXPECT_NEAR(found.stiffness_mpa[2][2], 25, 1e-4);
  EXPECT_NEAR(found.stiffness_mpa[0][0], 0, 1e-4);
  EXPECT_FALSE(constants_of(found.stiffness_mpa));
}

Section conducting(double conductivity) { return {"one", {}, conductivity}; }

// Resistances add across layers, conductances along them.
TEST(Homogenise, LayersConductInSeriesAndParallel) {
  const HomogenisedConductivity found = homogenise_conductivity(
      periodic({3, 6, 8}, {conducting(15), conducting(0.2)}, [](Cell c) { return c[2] < 2 ? 0 : 1; }, {1, 2, 0.5}),
      {1e-12});
  const double along = 0.25 * 15 + 0.75 * 0.2, across = 1 / (0.25 / 15 + 0.75 / 0.2);
  EXPECT_NEAR(found.conductivity[0][0], along, 1e-9);
  EXPECT_NEAR(found.conductivity[1][1], along, 1e-9);
  EXPECT_NEAR(found.conductivity[2][2], across, 1e-9);
  EXPECT_NEAR(found.conductivity[0][2], 0, 1e-9);
  EXPECT_NEAR(found.arithmetic_mean, along, 1e-12);
  EXPECT_NEAR(found.harmonic_mean, across, 1e-12);
}

// The conductivity of balls that conduct better than the matrix lies between the bounds of Hashin and Shtrikman (1962).
// The lower one is also Maxwell's formula for sparse balls, and so close.
TEST(Homogenise, ConductingBallsLieBetweenTheBoundsOfHashinAndShtrikman) {
  constexpr int32_t n = 24;
  int32_t outside = 0;
  const HomogenisedConductivity found =
      homogenise_conductivity(periodic({n, n, n}, {conducting(10), conducting(1)}, around_ball(n, 8, outside)), {1e-9});
  const double f = 1 - outside / static_cast<double>(n * n * n), k = found.conductivity[1][1];
  const double lower = 1 + f / (1 / (10 - 1.0) + (1 - f) / 3), upper = 10 + (1 - f) / (1 / (1 - 10.0) + f / 30);
  EXPECT_GT(k, lower);
  EXPECT_LT(k, upper);
  EXPECT_LT(k, 1.03 * lower);
  EXPECT_NEAR(found.conductivity[0][0], k, 1e-6);
  EXPECT_NEAR(found.conductivity[2][2], k, 1e-6);
}

// Columns along z conduct only along z.
TEST(Homogenise, VoidConductsNothing) {
  const HomogenisedConductivity found = homogenise_conductivity(
      periodic({4, 4, 4}, {conducting(8)}, [](Cell c) { return c[0] < 2 && c[1] < 2 ? 0 : -1; }), {1e-12});
  EXPECT_NEAR(found.conductivity[2][2], 2, 1e-9);
  EXPECT_NEAR(found.conductivity[0][0], 0, 1e-9);
  EXPECT_EQ(found.harmonic_mean, 0);
}

TEST(Homogenise, SameBitsOnAnyNumberOfThreads) {
  const Model model = periodic({5, 6, 7}, {{"a", {100, 0.3, 0}}, {"b", {1, 0.3, 0}}},
                               [](Cell c) { return (c[0] * 5 + c[1] * 3 + c[2] * 7) % 4 == 0 ? 0 : 1; });
  SolveOptions one, four;
  one.threads = 1;
  four.threads = 4;
  EXPECT_EQ(homogenise(model, one).stiffness_mpa, homogenise(model, four).stiffness_mpa);
}

}  // namespace
}  // namespace ombre::fea
