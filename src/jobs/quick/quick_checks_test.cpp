#include "jobs/quick/quick_checks.h"

#include <algorithm>
#include <numbers>

#include "jobs/stacks/test_stacks.h"

namespace ombre::compile {
namespace {

class QuickChecks : public StackTest {
 protected:
  QuickChecks() {
    options_.pitch = {Pitch{1, 10}, Pitch{1, 10}, Pitch{1, 10}};
    options_.finds_short_periods = true;
  }

  // Looks at a block whose red fraction is a formula.
  ShortPeriods periods(const std::string& formula) {
    return plan(load("fgrade([\"" + formula + "\", \"1 - (" + formula + ")\"], [red, blue]) rectprism([4, 4, 4]);"))
        .periods;
  }
  static std::string wave(double period_mm, const std::string& along) {
    return "0.5 + 0.5 * sin(" + std::to_string(2 * std::numbers::pi / period_mm) + " * " + along + ")";
  }

  NearMaterials near(const std::string& text, double within_mm, const std::string& other) {
    const Plan planned = plan(load(text));
    const auto id = [&](const std::string& name) {
      const auto found = std::ranges::find(planned.request.materials, name, &SliceMaterial::name);
      return found == planned.request.materials.end() ? MaterialId{0} : found->id;
    };
    return find_near_materials(planned.samples, planned.request.lattice, {id("blue"), id(other), within_mm}, nullptr);
  }
};

TEST_F(QuickChecks, PeriodsBelowTwoVoxelsAreFound) {
  for (const char* axis : {"x", "y", "z"}) {
    for (const double period : {0.07, 0.11, 0.15, 0.19}) {
      const ShortPeriods found = periods(wave(period, axis));
      EXPECT_EQ(found.places, 64U);  // a thousandth of 40 x 40 x 40 voxels, all inside
      EXPECT_EQ(found.found, found.places);
      EXPECT_EQ(found.axis, axis[0] - 'x');
      EXPECT_NEAR(found.period_mm, period, 1e-6);
    }
    for (const double period : {0.2, 0.23, 1.0}) EXPECT_EQ(periods(wave(period, axis)).found, 0U) << axis << period;
  }
}

TEST_F(QuickChecks, VoxelsOfEachAxisCount) {
  options_.pitch[2] = Pitch{1, 5};
  EXPECT_GT(periods(wave(0.3, "z")).found, 0U);
  EXPECT_EQ(periods(wave(0.3, "x")).found, 0U);
  EXPECT_EQ(periods(wave(0.41, "z")).found, 0U);
}

// The phase of a chirp grows by 2 pi k x^2, so its period at x is 1 / (2 k x): below 0.2 mm from x = 1 mm on, if k is
// 2.5.
TEST_F(QuickChecks, OnlyPlacesWithShortPeriodsCount) {
  const ShortPeriods found = periods("0.5 + 0.5 * cos(15.707963 * (x + 2) ^ 2)");
  EXPECT_NEAR(static_cast<double>(found.found) / static_cast<double>(found.places), 0.75, 0.06);
}

TEST_F(QuickChecks, RemaindersRepeatAndAnglesMayJump) {
  EXPECT_GT(periods("mod(x + 100, 0.15) / 0.15").found, 0U);
  EXPECT_EQ(periods("mod(x + 100, 0.3) / 0.3").found, 0U);
  EXPECT_EQ(periods("0.5 + 0.5 * sin(4 * theta)").found, 0U);
}

TEST_F(QuickChecks, OnlyPlacesInsideCount) {
  const ShortPeriods found =
      plan(load("intersection() { rectprism([4, 4, 4], red); translate(1, 0, 0) rectprism([2, 4, 4], red);"
                "}"))
          .periods;
  EXPECT_EQ(found.found, 0U);
  const std::string wavy = wave(0.1, "max(x, 0)");
  EXPECT_EQ(plan(load("fgrade([\"" + wavy + "\", \"1 - (" + wavy +
                      ")\"], [red, blue]) translate(-2, 0, 0) rectprism([3.8, 4, 4]);"))
                .periods.found,
            0U);
}

// A core of 2 mm, 0.2 mm below the surface of its shell.
TEST_F(QuickChecks, NeighboursInASampleAreFound) {
  const std::string part =
      "union() { rectprism([2, 2, 2], blue);"
      "difference() { rectprism([2.4, 2.4, 2.4], red); rectprism([2, 2, 2], red); } }";
  EXPECT_EQ(near(part, 0.2, "surface").found, 0U);
  const NearMaterials surface = near(part, 0.35, "surface");
  EXPECT_GT(surface.found, 0U);
  EXPECT_LT(surface.found, surface.voxels);
  EXPECT_GT(std::max({std::abs(surface.first_mm.x), std::abs(surface.first_mm.y), std::abs(surface.first_mm.z)}), 0.8);
  EXPECT_GT(near(part, 0.05, "red").found, 0U);
}

}  // namespace
}  // namespace ombre::compile
