#include "calibration/joint.h"

#include <cmath>

#include "calibration/test_calibrations.h"

namespace ombre::calibration {
namespace {

using namespace test;

CalibrationPtr mixture(const std::string& law, const std::string& values, const std::string& inputs = "") {
  return made(R"("inputs": [{"fraction": "A"}, {"fraction": "B")" + inputs + R"(}], "rest": "C", "interpolant": ")" +
              law + R"(", "constants": {"values": [)" + values + "]}");
}

// The moduli of C, A and B are 1, 100 and 10,000 MPa, whose logarithms mix; their densities are 1, 1.5 and 1.2.
MixtureLaw modulus() { return *mixture_law(*mixture("log-mixture", "1, 100, 10000")); }
MixtureLaw density() { return *mixture_law(*mixture("mixture", "1, 1.5, 1.2")); }

}  // namespace

TEST(Joint, FractionsHaveBothProperties) {
  ASSERT_TRUE(determine_fractions(modulus(), density()));
  for (const auto& [c, a, b] : {Fractions{0.5, 0.2, 0.3}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0.25, 0.75}}) {
    const double u = a * std::log(100) + b * std::log(10000), v = c + 1.5 * a + 1.2 * b;
    const auto found = fractions_of_properties(modulus(), density());
    const double wanted[] = {c, a, b};
    for (size_t n = 0; n < 3; ++n) EXPECT_NEAR(found[n][0] + found[n][1] * u + found[n][2] * v, wanted[n], 1e-12) << n;
  }
}

// The mixtures of 1.2 g/cm3 lie between B alone and 0.4 of A in C, which has 100^0.4 MPa.
TEST(Joint, ReachBesideTheOtherProperty) {
  const auto reach = reach_beside(modulus(), density(), 1.2);
  ASSERT_TRUE(reach);
  EXPECT_NEAR(reach->lo, std::pow(100, 0.4), 1e-9);
  EXPECT_NEAR(reach->hi, 10000, 1e-6);
  EXPECT_FALSE(reach_beside(modulus(), density(), 1.6));
  EXPECT_FALSE(reach_beside(modulus(), density(), 0.9));
  // Beside 1 MPa there is C alone.
  const auto alone = reach_beside(density(), modulus(), 1);
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->lo, 1);
  EXPECT_EQ(alone->hi, 1);
}

TEST(Joint, PropertiesThatFollowFromEachOtherDoNotDetermine) {
  const MixtureLaw one = *mixture_law(*mixture("mixture", "1, 2, 4")),
                   two = *mixture_law(*mixture("mixture", "10, 30, 70")),
                   constant = *mixture_law(*mixture("mixture", "5, 5, 5"));
  EXPECT_FALSE(determine_fractions(one, two));
  EXPECT_FALSE(determine_fractions(one, constant));
  EXPECT_TRUE(determine_fractions(one, density()));
}

TEST(Joint, OtherCalibrationsHaveNoLaw) {
  EXPECT_FALSE(mixture_law(*law("mixture", R"("values": [1, 2])")));
  EXPECT_FALSE(mixture_law(*law("percolation", R"("values": [1, 2], "threshold": 0.3)")));
  EXPECT_FALSE(mixture_law(*mixture("mixture", "1, 2, 3", R"(, "valid": [0, 0.5])")));
}

}  // namespace ombre::calibration
