// Compares minimal surfaces with published areas and with their own normals.
#include <cmath>
#include <random>

#include "nodes/test_solids.h"

namespace ombre::nodes {
namespace {

std::string sheet(const std::string& name, const std::string& thickness) {
  return "{\"surface\": \"" + name + "\", \"cell\": [1, 1, 1], \"thickness\": " + thickness + "}";
}

// Areas in a cubic cell of side one by Schroeder-Turk, Fogden, Hyde 2006, for the exact surfaces, which the
// trigonometric functions approximate.
TEST(Tpms, SheetsHaveThePublishedArea) {
  const std::map<std::string, double> areas{
      {"gyroid", 3.0915}, {"schwarz_p", 2.3451}, {"schwarz_d", 3.8378}, {"neovius", 3.5105}, {"iwp", 3.4646}};
  for (const auto& [name, area] : areas) {
    const Solid wall(Solid::node("tpms", sheet(name, "0.04")));
    std::mt19937 random(2);
    std::uniform_real_distribution<double> at(0, 1);
    constexpr int samples = 100000;
    int count = 0;
    for (int n = 0; n < samples; ++n) count += wall.inside({at(random), at(random), at(random)}) ? 1 : 0;
    EXPECT_NEAR(count / (0.04 * samples), area, 0.025 * area + 4 * std::sqrt(0.04 * area / samples) / 0.04) << name;
  }
}

// The two sides of these surfaces are congruent.
TEST(Tpms, SolidsFillHalf) {
  for (const std::string name : {"gyroid", "schwarz_p", "schwarz_d"}) {
    const Solid half(Solid::node("tpms", "{\"surface\": \"" + name + "\", \"kind\": \"solid\", \"cell\": [1, 1, 1]}"));
    EXPECT_NEAR(half.share({{0, 0, 0}, {1, 1, 1}}, 32), 0.5, 0.01) << name;
  }
}

// Measures the thickness from points of the surface along the normal, by bisection.
void expect_thickness(const std::string& name, double thickness, double tolerance) {
  const Solid side(Solid::node("tpms", "{\"surface\": \"" + name + "\", \"kind\": \"solid\", \"cell\": [1, 1, 1]}"));
  const Solid wall(Solid::node("tpms", sheet(name, std::to_string(thickness))));
  std::mt19937 random(4);
  std::uniform_real_distribution<double> at(0, 1);
  double worst = 0;
  int tried = 0;
  while (tried < 100) {
    Vec3 a{at(random), at(random), at(random)}, b{at(random), at(random), at(random)};
    if (side.inside(a) == side.inside(b)) continue;
    if (!side.inside(a)) std::swap(a, b);
    for (int n = 0; n < 50; ++n) (side.inside(0.5 * (a + b)) ? a : b) = 0.5 * (a + b);
    constexpr double h = 1e-5;
    const auto d = [&](Vec3 by) { return side.distance(a + by) - side.distance(a - by); };
    Vec3 normal{d({h, 0, 0}), d({0, h, 0}), d({0, 0, h})};
    normal = (1 / length(normal)) * normal;
    double in = 0, out = thickness;
    for (int n = 0; n < 40; ++n) (wall.inside(a + 0.5 * (in + out) * normal) ? in : out) = 0.5 * (in + out);
    worst = std::max(worst, std::abs(2 * in - thickness));
    ++tried;
  }
  EXPECT_LT(worst, tolerance * thickness) << name;
}

// docs/user/lattices.md promises this accuracy for walls that are thin compared with the surface's curvature.
TEST(Tpms, ThicknessIsInMillimetres) {
  for (const std::string name : {"gyroid", "schwarz_p", "schwarz_d"}) {
    expect_thickness(name, 0.05, 0.04);
    expect_thickness(name, 0.1, 0.08);
  }
  for (const std::string name : {"neovius", "iwp", "lidinoid", "split_p"}) expect_thickness(name, 0.03, 0.12);
}

// Counts points of a lattice that has no symmetry with the surface.
TEST(Tpms, FillsTheWantedShare) {
  const auto share = [](const std::string& parameters) {
    const Solid solid(Solid::node("tpms", "{\"cell\": [1, 1, 1], " + parameters + "}"));
    return solid.share({{0.0137, 0.0071, 0.0193}, {1.0137, 1.0071, 1.0193}}, 58);
  };
  EXPECT_NEAR(share(R"("surface": "gyroid", "kind": "solid", "density": 0.3)"), 0.3, 1e-3);
  EXPECT_NEAR(share(R"("surface": "schwarz_p", "kind": "solid", "density": 0.75)"), 0.75, 1e-3);
  EXPECT_NEAR(share(R"("surface": "split_p", "kind": "solid", "density": 0.4)"), 0.4, 1e-3);
  EXPECT_NEAR(share(R"("surface": "gyroid", "density": 0.25)"), 0.25, 1e-3);
}

// Constant fields must give the same result as numbers.
TEST(Tpms, FieldsThatAreConstantChangeNothing) {
  for (const std::string name : {"gyroid", "lidinoid", "split_p"}) {
    const Solid numbers(Solid::node("tpms", sheet(name, "0.1")));
    const Solid fields(Solid::node(
        "tpms", "{\"surface\": \"" + name + "\", \"cell\": [\"1 + 0*x\", 1, 1], \"thickness\": \"0.1 + 0*y\"}"));
    std::mt19937 random(6);
    std::uniform_real_distribution<double> at(0.1, 1);
    for (int n = 0; n < 100; ++n) {
      const Vec3 p{at(random), at(random), at(random)};
      if (std::abs(numbers.distance(p)) > 0.1) continue;  // far away, differences are inaccurate
      EXPECT_NEAR(numbers.distance(p), fields.distance(p), 2e-5);
    }
  }
}

}  // namespace
}  // namespace ombre::nodes
