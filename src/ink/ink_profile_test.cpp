// Tests of profiles that are made here from the arithmetic of light, and read by Little CMS.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "base/text/error.h"
#include "ink/droplet_model.h"
#include "ink/ink_table.h"

namespace ombre::ink {
namespace {

// Cyan, magenta, yellow, black, and white, which takes the rest; X, Y and Z relative to D50.
const std::vector<Vec3> lights{
    {0.20, 0.28, 0.75}, {0.35, 0.20, 0.30}, {0.72, 0.78, 0.10}, {0.02, 0.02, 0.02}, {0.90, 0.90, 0.88}};

// Returns what droplets show whose light adds up.
Lab shown_by(const std::vector<double>& shares) {
  Vec3 sum{};
  for (size_t n = 0; n < shares.size(); ++n) sum = sum + shares[n] * lights[n];
  return lab_of_xyz(sum);
}

// Returns patches with all shares in steps of 1/steps.
std::vector<Patch> patches_in_steps(int steps) {
  std::vector<Patch> patches;
  for (int c = 0; c <= steps; ++c)
    for (int m = 0; c + m <= steps; ++m)
      for (int y = 0; c + m + y <= steps; ++y)
        for (int k = 0; c + m + y + k <= steps; ++k) {
          Patch patch;
          for (const int count : {c, m, y, k, steps - c - m - y - k})
            patch.shares.push_back(static_cast<double>(count) / steps);
          patch.colour = shown_by(patch.shares);
          patches.push_back(patch);
        }
  return patches;
}

const DropletModel& model() {
  static const DropletModel made(patches_in_steps(2));
  return made;
}

const Profile& profile() {
  static const Profile made{"made.icc",
                            std::make_shared<const std::string>(make_profile(tables_of(model(), "made for a test")))};
  return made;
}

// A colour's shares with the rest, and the colour relative to the rest alone.
Lab relative_shown(std::vector<double> shares) {
  shares.push_back(1 - std::accumulate(shares.begin(), shares.end(), 0.0));
  const Vec3 xyz = xyz_of_lab(shown_by(shares)), white = lights.back();
  return lab_of_xyz({xyz.x / white.x, xyz.y / white.y, xyz.z / white.z});
}

const std::vector<std::vector<double>> mixtures{{0.1, 0.2, 0.3, 0.1},    {0.5, 0, 0, 0},     {0, 0.4, 0.4, 0.1},
                                                {0.05, 0.05, 0.05, 0.3}, {0.3, 0.3, 0.3, 0}, {0, 0, 0, 0}};

TEST(DropletModel, FindsThatLightAddsUp) {
  EXPECT_EQ(model().n(), 1);
  EXPECT_LT(model().error().worst, 1e-6);
  for (const Patch& patch : patches_in_steps(3)) EXPECT_LT(ciede2000(model().colour(patch.shares), patch.colour), 1e-6);
}

TEST(DropletModel, KeepsWhatWasMeasured) {
  std::vector<Patch> patches = patches_in_steps(2);
  for (Patch& patch : patches)
    if (*std::ranges::max_element(patch.shares) < 1) patch.colour.x -= 5;  // darker than the mean of light
  const DropletModel darker(patches);
  for (const Patch& patch : patches) EXPECT_LT(length(darker.colour(patch.shares) - patch.colour), 1e-9);
  EXPECT_GT(darker.error().worst, 0.1);
}

TEST(DropletModel, SharesShowTheColour) {
  for (const Patch& patch : patches_in_steps(4)) {
    const std::vector<double> found = model().shares(patch.colour);
    EXPECT_LT(ciede2000(shown_by(found), patch.colour), 0.05);
    EXPECT_NEAR(std::accumulate(found.begin(), found.end(), 0.0), 1, 1e-8);
  }
}

// Beyond the gamut, no mixture in steps of an eighth is nearer.
TEST(DropletModel, SharesAreThoseOfTheNearestColour) {
  const std::vector<Patch> all = patches_in_steps(8);
  for (const Lab& wanted :
       std::vector<Lab>{{28.6, -34, 34.8}, {54, 81, 70}, {30, 68, -112}, {88, -79, 81}, {0, 0, 0}}) {
    double least = 1000;
    for (const Patch& patch : all) least = std::min(least, length(patch.colour - wanted));
    EXPECT_LT(length(shown_by(model().shares(wanted)) - wanted), least + 0.5) << wanted.x;
  }
}

TEST(DropletModel, NamesAMaterialThatNoPatchHasAlone) {
  std::vector<Patch> patches = patches_in_steps(2);
  EXPECT_EQ(DropletModel::missing_alone(patches), std::nullopt);
  std::erase_if(patches, [](const Patch& patch) { return patch.shares[2] == 1; });
  EXPECT_EQ(DropletModel::missing_alone(patches), size_t{2});
}

TEST(InkProfile, SaysWhatItIs) {
  const ProfileFacts facts = facts_of(profile());
  EXPECT_EQ(facts.channels, 4U);
  EXPECT_EQ(facts.space, "CMYK");
  EXPECT_EQ(facts.description, "made for a test");
}

TEST(InkProfile, ShowsWhatTheLightOfDropletsIs) {
  for (const auto& shares : mixtures) {
    const Lab wanted = relative_shown(shares), found = colours_of(profile(), Intent::relative, shares).front();
    EXPECT_LT(ciede2000(found, wanted), 0.7) << wanted.x << ' ' << wanted.y << ' ' << wanted.z;  // a table of 17 steps
    std::vector<double> all = shares;
    all.push_back(1 - std::accumulate(shares.begin(), shares.end(), 0.0));
    const Lab absolute = colours_of(profile(), Intent::absolute, shares).front();
    EXPECT_LT(ciede2000(absolute, shown_by(all)), 0.7);
  }
}

// Colours that some mixture shows come back from sRGB by way of the shares.
TEST(InkProfile, InverseAfterForwardIsTheColour) {
  std::vector<Vec3> screen;
  for (const double level : {0.35, 0.5, 0.65, 0.8}) screen.push_back({level, level, level});
  screen.insert(screen.end(), {{0.6, 0.5, 0.4}, {0.45, 0.55, 0.5}, {0.55, 0.45, 0.55}});
  const auto shares = shares_of(profile(), {Intent::relative, false}, screen);
  const auto back = colours_of(profile(), Intent::relative, shares);
  for (size_t n = 0; n < screen.size(); ++n) EXPECT_LT(ciede2000(back[n], lab_of_srgb(screen[n])), 1) << n;
}

TEST(InkProfile, WhiteIsTheMediumAndBlackTheDarkest) {
  const auto shares = shares_of(profile(), {Intent::relative, true}, std::vector<Vec3>{{1, 1, 1}, {0, 0, 0}});
  for (size_t n = 0; n < 4; ++n) EXPECT_LT(shares[n], 1e-3) << "white";
  EXPECT_GT(shares[7], 0.95) << "black";
}

TEST(InkProfile, HasTheSameBytesEachTime) {
  EXPECT_EQ(make_profile(tables_of(model(), "made for a test", 1)), *profile().bytes);
}

TEST(InkProfile, RefusesWhatIsNone) {
  const auto message = [](const std::string& bytes) -> std::string {
    try {
      shares_of({"wrong.icc", std::make_shared<const std::string>(bytes)}, {}, std::vector<Vec3>{{1, 1, 1}});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message("not a profile").find("\"wrong.icc\" cannot be used"), std::string::npos);
  EXPECT_NE(message(profile().bytes->substr(0, 500)).find("cannot be used"), std::string::npos);
  std::string screen = *profile().bytes;
  screen.replace(12, 4, "mntr");
  EXPECT_NE(message(screen).find("an output profile (prtr) of inks"), std::string::npos) << message(screen);
}

TEST(InkTable, SharesOfDropletsAddUpToOneAtMost) {
  std::vector<double> shares{0.5, 0.25, 0.75, 0.5, 0.25, 0.25, 0.25, 0};
  divide_above_one(shares, 4);
  EXPECT_EQ(shares, (std::vector<double>{0.25, 0.125, 0.375, 0.25, 0.25, 0.25, 0.25, 0}));
}

TEST(InkTable, IsNearTheProfileBetweenItsColours) {
  const InkTable table = make_ink_table(profile(), {});
  ASSERT_EQ(table.values.size(), 5U);
  EXPECT_EQ(table.values[0].size(), InkTable::steps * InkTable::steps * InkTable::steps);
  EXPECT_LT(table.mean_error, 0.5);
  EXPECT_LT(table.worst_error, 8);
  const InkTable by_one = make_ink_table(profile(), {}, 1);
  EXPECT_EQ(by_one.values, table.values);
}

}  // namespace
}  // namespace ombre::ink
