// Compares mixtures that show a colour with the arithmetic of light.
#include "ink/colour_mixer.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace ombre::ink {
namespace {

Vec3 shown(const std::vector<Vec3>& colours, const std::vector<double>& shares) {
  Vec3 sum{};
  for (size_t n = 0; n < colours.size(); ++n) sum = sum + shares[n] * colours[n];
  return sum;
}

const std::vector<Vec3> inks{{0, 0.4, 0.7}, {0.6, 0, 0.3}, {0.9, 0.8, 0}, {0, 0, 0}, {0.95, 0.95, 0.95}};

TEST(ColourMixer, ShowsWhatIsInTheGamut) {
  const ColourMixer mixer(inks);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  for (int n = 0; n < 200; ++n) {
    std::vector<double> made;
    for (size_t i = 0; i < inks.size(); ++i) made.push_back(uniform(random));
    const double total = std::accumulate(made.begin(), made.end(), 0.0);
    for (double& share : made) share /= total;
    const Vec3 wanted = shown(inks, made);
    const std::vector<double> found = mixer.shares(wanted);
    EXPECT_NEAR(length(shown(inks, found) - wanted), 0, 1e-6);
    EXPECT_NEAR(std::accumulate(found.begin(), found.end(), 0.0), 1, 1e-8);
    // The mixture varies no more than any other with this colour, such as the one from which the colour was made.
    const auto variation = [](const std::vector<double>& shares) {
      double sum = 0;
      for (size_t i = 0; i < inks.size(); ++i) {
        const double y = 0.2126 * inks[i].x + 0.7152 * inks[i].y + 0.0722 * inks[i].z;
        sum += shares[i] * y * y;
      }
      return sum;
    };
    EXPECT_LE(variation(found), variation(made) + 1e-7);
  }
}

TEST(ColourMixer, GivesTheNearestBeyondTheGamut) {
  const ColourMixer mixer({{0, 0, 0}, {1, 1, 1}});
  // The nearest gray to pure red is its foot on the line from black to white, a third of the way.
  const std::vector<double> red = mixer.shares({1, 0, 0});
  EXPECT_NEAR(red[0], 2.0 / 3, 1e-12);
  EXPECT_NEAR(red[1], 1.0 / 3, 1e-12);
  EXPECT_EQ(mixer.shares({2, 2, 2}), (std::vector<double>{0, 1}));
}

TEST(ColourMixer, TakesColoursThatAreAlike) {
  const ColourMixer mixer({{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}});
  EXPECT_EQ(mixer.shares({0.2, 0.9, 0.4}), (std::vector<double>{1, 0}));
}

}  // namespace
}  // namespace ombre::ink
