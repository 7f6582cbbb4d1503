#include "load/resolved.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "calibration/test_calibrations.h"
#include "load/find_calibration.h"
#include "load/load.h"
#include "questions/reach_survey.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

using calibration::CalibrationPtr;

LoadedPtr loaded(const std::string& text) {
  setenv("OMBRE_DATA", OMBRE_SOURCE_DIR, 1);
  Diagnostics diagnostics;
  LoadOptions options;
  options.materials = OMBRE_SOURCE_DIR "/materials/j750.json";
  auto design = load_text(text, "part.vcad", options, diagnostics);
  EXPECT_TRUE(design) << to_text(diagnostics);
  return design;
}

CalibrationPtr shipped(const std::string& name) {
  setenv("OMBRE_DATA", OMBRE_SOURCE_DIR, 1);
  Diagnostics diagnostics;
  auto calibration = find_calibration(name, diagnostics);
  EXPECT_TRUE(calibration) << to_text(diagnostics);
  return calibration;
}

std::string problem(const LoadedPtr& design, const std::vector<CalibrationPtr>& calibrations,
                    const std::vector<std::string>& needs = {"fractions"}) {
  Diagnostics diagnostics;
  EXPECT_FALSE(resolve(design, calibrations, needs, Unresolved::is_error, diagnostics));
  return to_text(diagnostics);
}

Resolution resolved(const LoadedPtr& design, const std::vector<CalibrationPtr>& calibrations,
                    const std::vector<std::string>& needs = {"fractions"}) {
  Diagnostics diagnostics;
  auto resolution = resolve(design, calibrations, needs, Unresolved::is_error, diagnostics);
  EXPECT_TRUE(resolution) << to_text(diagnostics);
  return resolution.value_or(Resolution());
}

// Returns the fraction of a material, or an attribute, at a point.
double value_at(const Resolution& resolution, const std::string& name, const Vec3& point) {
  SampleQuery query;
  query.fractions = true;
  for (const char* attribute : {"temperature", "flow_rate"})
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
  const Resolution from_temperature = resolved(loaded("attribute(\"temperature\", 238) cube(10);"), {flow}, needs);
  EXPECT_NEAR(value_at(from_temperature, "flow_rate", {0, 0, 0}), 1.04, 1e-9);  // the middle of 1.42 and 0.66
  const Resolution from_flow = resolved(loaded("attribute(\"flow_rate\", 1.04) cube(10);"), {flow}, needs);
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
