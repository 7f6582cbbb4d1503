#include "load/resolved.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "base/system/test_source_files.h"
#include "calibration/test_calibrations.h"
#include "load/find_calibration.h"
#include "load/load.h"
#include "questions/reach_survey.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

using calibration::CalibrationPtr;

LoadedPtr loaded(const std::string& text) {
  setenv("OMBRE_DATA", source_file().c_str(), 1);
  Diagnostics diagnostics;
  LoadOptions options;
  options.materials = source_file("materials/j750.json");
  auto design = load_text(text, "part.vcad", options, diagnostics);
  EXPECT_TRUE(design) << to_text(diagnostics);
  return design;
}

CalibrationPtr shipped(const std::string& name) {
  setenv("OMBRE_DATA", source_file().c_str(), 1);
  Diagnostics diagnostics;
  auto calibration = find_calibration(name, diagnostics);
  EXPECT_TRUE(calibration) << to_text(diagnostics);
  return calibration;
}

std::string problem(const LoadedPtr& design, const std::vector<CalibrationPtr>& calibrations,
                    const std::vector<std::string>& needs = {"fractions"}) {
  Diagnostics diagnostics;
  EXPECT_FALSE(resolve(design, calibrations, {needs}, diagnostics));
  return to_text(diagnostics);
}

Resolution resolved(const LoadedPtr& design, const std::vector<CalibrationPtr>& calibrations,
                    const Needs& needs = {{"fractions"}}) {
  Diagnostics diagnostics;
  auto resolution = resolve(design, calibrations, needs, diagnostics);
  EXPECT_TRUE(resolution) << to_text(diagnostics);
  return resolution.value_or(Resolution());
}

// Returns the fraction of a material, or an attribute, at a point.
double value_at(const Resolution& resolution, const std::string& name, const Vec3& point) {
  SampleQuery query;
  query.fractions = true;
  for (const char* attribute :
       {"temperature", "flow_rate", "infill_density", "density_place_in_reach", "modulus_and_density_place_in_reach"})
    if (name == attribute) query.attributes.push_back(name);
  Diagnostics diagnostics;
  const auto sampler = Sampler::build(resolution.loaded->design, query, diagnostics);
  if (!sampler) return std::nan("");
  std::vector<double> values(sampler->columns().size());
  std::vector<double*> columns;
  for (double& value : values) columns.push_back(&value);
  sampler->sample(std::vector{point}, columns);
  for (size_t n = 0; n < values.size(); ++n)
    if (sampler->columns()[n].name == name) return values[n];
  return std::nan("");
}

const char* const graded = "attribute(\"modulus\", \"10 + 100*(z + 5)\") cube(10);";

}  // namespace

// The rule is log-linear, so that the fraction is known exactly.
TEST(Resolved, FractionsHaveTheRequestedModulus) {
  const Resolution resolution = resolved(loaded(graded), {shipped("agilus-vero-modulus")});
  ASSERT_EQ(resolution.steps.size(), 1U);
  EXPECT_EQ(resolution.steps[0].materials, (std::vector<std::string>{"VeroClear", "Agilus30Clr"}));
  for (const double z : {-4.9, -2.0, 0.3, 4.9}) {
    const double share = std::log((10 + 100 * (z + 5)) / 0.383) / std::log(2850 / 0.383);
    EXPECT_NEAR(value_at(resolution, "VeroClear", {1, 2, z}), share, 1e-9);
    EXPECT_NEAR(value_at(resolution, "Agilus30Clr", {1, 2, z}), 1 - share, 1e-9);
  }
}

// Any curve: the calibration's own value at the fraction is what was requested for.
TEST(Resolved, CurvesAreFollowed) {
  const auto pchip = calibration::test::made(R"("inputs": [{"fraction": "VeroClear"}], "rest": "Agilus30Clr",
      "interpolant": "pchip", "points": [{"inputs": [0], "value": 0.6}, {"inputs": [0.25], "value": 3.1},
      {"inputs": [0.5], "value": 60}, {"inputs": [0.75], "value": 700}, {"inputs": [1], "value": 2200}])");
  const Resolution resolution = resolved(loaded(graded), {pchip});
  for (const double z : {-4.9, -2.0, 0.3, 4.9}) {
    const double share = value_at(resolution, "VeroClear", {0, 0, z}), requested = 10 + 100 * (z + 5);
    EXPECT_NEAR(pchip->inverse(0, requested, pchip->usual()).input, share, 1e-6);
    EXPECT_NEAR(pchip->value(std::vector{share}), requested, 2e-3);
  }
}

TEST(Resolved, ValuesOutOfReachGiveTheNearest) {
  const Resolution resolution =
      resolved(loaded("attribute(\"modulus\", \"1000*x\") cube(10);"), {shipped("agilus-vero-modulus")});
  EXPECT_EQ(value_at(resolution, "VeroClear", {4, 0, 0}), 1);
  EXPECT_EQ(value_at(resolution, "VeroClear", {-4, 0, 0}), 0);
}

TEST(Resolved, SettingsFollowOneAnother) {
  const auto flow = shipped("foaming-pla-flow");
  const std::vector<std::string> needs{"temperature", "flow_rate"};
  const Resolution from_temperature = resolved(loaded("attribute(\"temperature\", 238) cube(10);"), {flow}, {needs});
  EXPECT_NEAR(value_at(from_temperature, "flow_rate", {0, 0, 0}), 1.04, 1e-9);  // the middle of 1.42 and 0.66
  const Resolution from_flow = resolved(loaded("attribute(\"flow_rate\", 1.04) cube(10);"), {flow}, {needs});
  EXPECT_NEAR(value_at(from_flow, "temperature", {0, 0, 0}), 238, 1e-6);
}

TEST(Resolved, ProblemsAreExplained) {
  const auto modulus = shipped("agilus-vero-modulus"), density = shipped("agilus-vero-density");
  const auto both = loaded("attribute(\"density\", 1.16) attribute(\"modulus\", 10) cube(10);");
  EXPECT_NE(problem(both, {modulus, density}).find("two chains of calibrations lead to fractions"), std::string::npos);
  EXPECT_EQ(resolved(both, {density}).steps.size(), 1U);
  const auto other = loaded("attribute(\"hu\", 10) cube(10);");
  EXPECT_NE(problem(other, {modulus}).find("it could give modulus (agilus-vero-modulus)"), std::string::npos);
  EXPECT_NE(problem(loaded("attribute(\"modulus\", 10, unit=\"GPa\") cube(10);"), {modulus}).find("has the unit GPa"),
            std::string::npos);
  const auto unknown = calibration::test::law("mixture", R"("values": [1, 2])");  // of Vero and Agilus
  EXPECT_NE(problem(loaded(graded), {unknown}).find("needs the material Vero, which the materials file lacks"),
            std::string::npos);
}

namespace {

// Density by two settings, linear in both: 0.1 g/cm3 for each 10 % of infill at 200 degrees, half of that at 250.
CalibrationPtr foam(const std::string& interpolant = "linear") {
  return calibration::test::made(R"("name": "foam", "property": "density", "unit": "g/cm3", "interpolant": ")" +
                                 interpolant + R"(", "inputs": [{"attribute": "infill_density", "unit": "%"},
      {"attribute": "temperature"}], "points": [
      {"inputs": [20, 200], "value": 0.2}, {"inputs": [20, 250], "value": 0.1},
      {"inputs": [60, 200], "value": 0.6}, {"inputs": [60, 250], "value": 0.3},
      {"inputs": [100, 200], "value": 1.0}, {"inputs": [100, 250], "value": 0.5}])");
}

CalibrationPtr softness() {
  return calibration::test::made(R"("name": "softness", "property": "shore_hardness", "unit": "Shore A",
      "inputs": [{"attribute": "temperature"}], "interpolant": "linear",
      "points": [{"inputs": [200], "value": 90}, {"inputs": [250], "value": 40}])");
}

CalibrationPtr density_of_mixture() {
  return calibration::test::made(R"("name": "d", "property": "density", "unit": "g/cm3", "interpolant": "mixture",
      "inputs": [{"fraction": "VeroClear"}], "rest": "Agilus30Clr", "constants": {"values": [1, 2]})");
}

CalibrationPtr modulus_of_three() {
  return calibration::test::made(R"("name": "m", "property": "modulus", "unit": "MPa", "interpolant": "log-mixture",
      "inputs": [{"fraction": "VeroClear"}, {"fraction": "VeroPureWht"}], "rest": "Agilus30Clr",
      "constants": {"values": [1, 100, 10000]})");
}

// Values are those of VeroClear, VeroPureWht and Agilus30Clr.
CalibrationPtr density_of_three(const std::string& values) {
  return calibration::test::made(R"("name": "d", "property": "density", "unit": "g/cm3", "interpolant": "mixture",
      "inputs": [{"fraction": "VeroPureWht"}, {"fraction": "Agilus30Clr"}], "rest": "VeroClear",
      "constants": {"values": )" +
                                 values + "}");
}

CalibrationPtr hardness_of_mixture() {
  return calibration::test::made(R"("name": "h", "property": "shore_hardness", "unit": "Shore A",
      "inputs": [{"fraction": "VeroClear"}], "rest": "Agilus30Clr", "interpolant": "mixture",
      "constants": {"values": [30, 90]})");
}

}  // namespace

// The hardness gives the temperature, and both together the infill.
TEST(Resolved, TwoPropertiesGiveTwoSettings) {
  const auto design = loaded(R"(attribute("density", "0.25 + 0.01*z") attribute("shore_hardness", 65) cube(10);)");
  for (const char* interpolant : {"linear", "log-linear"}) {
    const Resolution both = resolved(design, {foam(interpolant), softness()}, {{"temperature", "infill_density"}});
    ASSERT_EQ(both.steps.size(), 2U);
    EXPECT_NEAR(value_at(both, "temperature", {0, 0, 2}), 225, 1e-6);
    // At 225 degrees the density is 0.15, 0.45 and 0.75 at the three keys, or the geometric means of 0.2 and 0.1, ...
    const bool is_log = std::string(interpolant) == "log-linear";
    const double low = is_log ? std::sqrt(0.2 * 0.1) : 0.15, high = is_log ? std::sqrt(0.6 * 0.3) : 0.45;
    for (const double z : {-4.0, 0.0, 4.0}) {
      const double wanted = 0.25 + 0.01 * z;
      const double share = is_log ? std::log(wanted / low) / std::log(high / low) : (wanted - low) / (high - low);
      EXPECT_NEAR(value_at(both, "infill_density", {1, 1, z}), 20 + 40 * share, 1e-6) << interpolant;
    }
  }
}

TEST(Resolved, ReachVariesWithOtherAttributes) {
  const auto design = loaded(R"x(attribute("density", "0.1*(z + 5)") attribute("temperature", 250) cube(10);)x");
  const Resolution hot = resolved(design, {foam()}, {{"temperature", "infill_density"}});
  ASSERT_EQ(hot.steps.size(), 1U);
  EXPECT_EQ(hot.steps[0].place_in_reach, "density_place_in_reach");
  EXPECT_EQ(hot.steps[0].reach.lo, 0.1);
  EXPECT_EQ(hot.steps[0].reach.hi, 1.0);
  // 0.1 to 0.5 is reached at 250 degrees.
  EXPECT_NEAR(value_at(hot, "density_place_in_reach", {0, 0, -4}), 1, 1e-9);
  EXPECT_NEAR(value_at(hot, "density_place_in_reach", {0, 0, -2}), 1.5, 1e-9);
  EXPECT_NEAR(value_at(hot, "density_place_in_reach", {0, 0, 4}), 1 + 0.8 / 0.4, 1e-9);
  EXPECT_EQ(value_at(hot, "infill_density", {0, 0, 4}), 100);
  EXPECT_NEAR(value_at(hot, "infill_density", {0, 0, -2}), 60, 1e-6);
}

// The moduli of Agilus, Vero and white mix by their logarithms, 1, 100 and 10,000 MPa; the densities, in another order
// of the materials, are 1, 1.5 and 1.2 g/cm3.
TEST(Resolved, TwoPropertiesGiveTheFractionsOfThreeMaterials) {
  const std::vector<CalibrationPtr> both{modulus_of_three(), density_of_three("[1.5, 1.2, 1]")};
  // Vero from 0.1 to 0.3, white from 0.5 to 0.3, the rest 0.4.
  const Resolution resolution =
      resolved(loaded(R"x(attribute("modulus", "exp((0.2 + 0.02*z)*log(100) + (0.4 - 0.02*z)*log(10000))")
                 attribute("density", "0.4 + 1.5*(0.2 + 0.02*z) + 1.2*(0.4 - 0.02*z)") cube(10);)x"),
               both);
  ASSERT_EQ(resolution.steps.size(), 1U);
  EXPECT_EQ(resolution.steps[0].step.text(), "modulus and density to fractions by m and d");
  for (const double z : {-4.9, 0.0, 3.2}) {
    EXPECT_NEAR(value_at(resolution, "VeroClear", {1, 2, z}), 0.2 + 0.02 * z, 1e-9);
    EXPECT_NEAR(value_at(resolution, "VeroPureWht", {1, 2, z}), 0.4 - 0.02 * z, 1e-9);
    EXPECT_NEAR(value_at(resolution, "Agilus30Clr", {1, 2, z}), 0.4, 1e-9);
    // 1 plus the least of the three.
    EXPECT_NEAR(value_at(resolution, "modulus_and_density_place_in_reach", {1, 2, z}),
                1 + std::min(0.2 + 0.02 * z, 0.4), 1e-9);
  }
}

// Shares of -0.2, 0.4 and 0.8 become 0, 1/3 and 2/3.
TEST(Resolved, TwoPropertiesOutOfReachGiveAMixtureNearby) {
  const Resolution resolution = resolved(loaded(R"x(attribute("modulus", "exp(0.4*log(100) + 0.8*log(10000))")
                 attribute("density", -0.2 + 1.5*0.4 + 1.2*0.8) cube(10);)x"),
                                         {density_of_three("[1.5, 1.2, 1]"), modulus_of_three()});
  EXPECT_NEAR(value_at(resolution, "Agilus30Clr", {0, 0, 0}), 0, 1e-9);
  EXPECT_NEAR(value_at(resolution, "VeroClear", {0, 0, 0}), 1.0 / 3, 1e-9);
  EXPECT_NEAR(value_at(resolution, "VeroPureWht", {0, 0, 0}), 2.0 / 3, 1e-9);
}

TEST(Resolved, ThreeMaterialsAreNotDeterminedByOneProperty) {
  const auto both = loaded(R"(attribute("modulus", 50) attribute("density", 1.2) cube(10);)");
  const auto modulus = modulus_of_three();
  // Its values are the logarithms of the moduli, so that both say the same.
  const std::string same = problem(both, {modulus, density_of_three("[2, 4, 0]")});
  EXPECT_NE(same.find("by m and d modulus and density follow from each other"), std::string::npos) << same;
  EXPECT_NE(problem(both, {modulus}).find("no calibration leads from there to fractions"), std::string::npos);
  const auto again = calibration::test::made(R"("name": "again", "property": "density", "unit": "g/cm3",
      "inputs": [{"fraction": "VeroPureWht"}, {"fraction": "VeroClear"}], "rest": "Agilus30Clr",
      "interpolant": "mixture", "constants": {"values": [1, 1.3, 1.6]})");
  const std::string several = problem(both, {modulus, density_of_three("[1.5, 1.2, 1]"), again});
  EXPECT_NE(several.find("modulus and density to fractions by m and d; and modulus and density to fractions by m and "
                         "again"),
            std::string::npos)
      << several;
}

TEST(Resolved, TwoPropertiesOfOneMixtureAgreeOrContradict) {
  const std::vector<CalibrationPtr> both{density_of_mixture(), hardness_of_mixture()};
  // A quarter of Vero has 1.25 g/cm3 and 45 Shore A.
  const auto agreeing =
      loaded(R"(attribute("density", "1.25 + z/20") attribute("shore_hardness", "45 + 3*z") cube(10);)");
  const Resolution one = resolved(agreeing, both);
  EXPECT_EQ(one.steps.size(), 1U);
  EXPECT_EQ(one.agreeing.size(), 1U);
  EXPECT_NEAR(value_at(one, "VeroClear", {0, 0, 2}), 0.35, 1e-6);
  const auto contrary = loaded(R"(attribute("density", 1.25) attribute("shore_hardness", "47.4 + 2.4*z") cube(10);)");
  const std::string text = problem(contrary, both);
  EXPECT_NE(text.find("two chains of calibrations lead to fractions: density to fractions by d; and shore_hardness to "
                      "fractions by h; they contradict each other: at"),
            std::string::npos)
      << text;
  // At the highest points, z = 4.875, the hardness is 59.1, which needs 0.485 of Vero. Both fractions differ as much.
  const auto says = [&](const std::string& words) { return text.find(words) != std::string::npos; };
  EXPECT_TRUE(says("density needs a fraction of VeroClear 0.25, and shore_hardness needs 0.485") ||
              says("density needs a fraction of Agilus30Clr 0.75, and shore_hardness needs 0.515"))
      << text;
  EXPECT_NE(text.find("--deciding ATTRIBUTE"), std::string::npos) << text;
  Needs needs{{"fractions"}};
  needs.deciding = {"shore_hardness"};
  EXPECT_NEAR(value_at(resolved(contrary, both, needs), "VeroClear", {0, 0, 2}), 0.37, 1e-6);
  needs.deciding = {"shore_hardnes"};
  Diagnostics diagnostics;
  EXPECT_FALSE(resolve(contrary, both, needs, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("did you mean \"shore_hardness\"?"), std::string::npos) << to_text(diagnostics);
}

TEST(Resolved, MachinesRoundWhatTheyTake) {
  Needs needs{{"fractions"}};
  needs.steps = {{"fractions", 0.25}};
  const auto mixture = loaded(R"(attribute("density", "1.5 + z/10") cube(10);)");
  const Resolution quarters = resolved(mixture, {density_of_mixture()}, needs);
  EXPECT_EQ(value_at(quarters, "VeroClear", {0, 0, -1.5}), 0.25);  // 0.35
  EXPECT_EQ(value_at(quarters, "VeroClear", {0, 0, -1}), 0.5);     // 0.4
  EXPECT_EQ(value_at(quarters, "Agilus30Clr", {0, 0, -1}), 0.5);
  EXPECT_EQ(value_at(quarters, "VeroClear", {0, 0, 4.9}), 1);  // 0.99
  // Values that a design gives itself are rounded, too, before they give other settings.
  needs = {{"temperature", "flow_rate"}, {{"temperature", 6}}};
  const Resolution hot =
      resolved(loaded("attribute(\"temperature\", 239) cube(10);"), {shipped("foaming-pla-flow")}, needs);
  EXPECT_EQ(value_at(hot, "temperature", {0, 0, 0}), 240);
  EXPECT_NEAR(value_at(hot, "flow_rate", {0, 0, 0}), 1.42 - 0.76 * 20 / 36, 1e-9);
  EXPECT_EQ(hot.rounded.size(), 1U);
}

// Materials that the design names stay.
TEST(Resolved, MaterialsAreKept) {
  const auto design = loaded("attribute(\"modulus\", 10) cube(10, \"VeroBlack\");");
  const Resolution resolution = resolved(design, {shipped("agilus-vero-modulus")});
  EXPECT_TRUE(resolution.steps.empty());
  EXPECT_EQ(resolution.loaded, design);
}

TEST(ReachSurvey, CountsWhatLiesBeyond) {
  const auto design = loaded("attribute(\"modulus\", \"1000*x\") cube(10);");
  voxel::Lattice lattice;
  lattice.origin = {-5, -5, -5};
  lattice.pitch.fill(*Pitch::from_mm(0.5));
  lattice.count = {20, 20, 20};
  Diagnostics diagnostics;
  const auto found = survey_reach(design->design, lattice, {{"modulus", {-1e9, 2850}}, {"modulus", {-1e9, 1e9}}}, 0,
                                  nullptr, diagnostics);
  ASSERT_TRUE(found);
  // x = 3.25, 3.75, 4.25 and 4.75 of 20 by 20 rows.
  EXPECT_EQ((*found)[0].voxels, 4U * 400U);
  EXPECT_EQ((*found)[0].worst, 4750);
  EXPECT_EQ((*found)[0].worst_mm, (Vec3{4.75, -4.75, -4.75}));
  EXPECT_EQ((*found)[1].voxels, 0U);
}

}  // namespace ombre::compile
