// Compares tables of mixtures with the arithmetic of light.
#include "nodes/values/colour_table.h"

#include <gtest/gtest.h>

namespace ombre::nodes {
namespace {

TEST(ColourTable, IsRightAtItsColoursAndNearBetween) {
  const ink::ColourMixer mixer({{0, 0, 0}, {1, 1, 1}});
  const program::SourceField table = make_colour_table(mixer, 2);
  // sRGB 0.5 is ((0.5 + 0.055) / 1.055)^2.4 in linear light.
  EXPECT_NEAR(table->sample(1, {0.5, 0.5, 0.5}), 0.21404114048, 1e-9);
  EXPECT_NEAR(table->sample(0, {0.5, 0.5, 0.5}), 1 - 0.21404114048, 1e-9);
  // IEC 61966-2-1 gives 0.5775804405 for 200 of 255. Between two colours of the table, the line is above the curve by
  // at most an eighth of its second derivative (1.4 * 2.4 / 1.055^2 * 0.797^0.4 < 2.8) times 1/32 squared.
  const double v = 200 / 255.0, light = table->sample(1, {v, v, v});
  EXPECT_GE(light, 0.5775804405 - 1e-9);
  EXPECT_LE(light, 0.5775804405 + 2.8 / 8 / 1024);
}

}  // namespace
}  // namespace ombre::nodes
