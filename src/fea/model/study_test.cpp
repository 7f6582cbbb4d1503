#include "fea/model/study.h"

#include <gtest/gtest.h>

#include "base/text/json.h"
#include "fea/model/test_models.h"

namespace ombre::fea {
namespace {

using namespace test;

std::optional<Study> study_of(const std::string& text, Diagnostics& diagnostics) {
  const auto data = parse_json(make_source("study.json", text), diagnostics);
  return data ? read_study(*data, diagnostics) : std::nullopt;
}

// Returns the message about a wrong study.
std::string complaint(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(study_of(text, diagnostics));
  return to_text(diagnostics);
}

Model cube() { return model_of(block({2, 2, 2}, {1, 1, 1}), {1000, 0.3, 2e-9}); }

std::optional<Conditions> conditions_in(const std::string& text, const Model& model, Diagnostics& diagnostics) {
  const auto study = study_of(text, diagnostics);
  return study ? conditions_of(*study, model, diagnostics) : std::nullopt;
}

Vec3 sum(const std::vector<Prescribed>& values) {
  Vec3 total;
  for (const Prescribed& value : values) total[value.axis] += value.value;
  return total;
}

const char* const held_below = R"("supports": [{"on": "zmin", "fix": "xyz"}])";

TEST(Study, CellsThatRepeatHaveAMeanStrainAlone) {
  Diagnostics diagnostics;
  const auto study = study_of(R"({"mean_strain": [0.01, 0, 0, 0, 0.5, 0]})", diagnostics);
  ASSERT_TRUE(study) << to_text(diagnostics);
  EXPECT_EQ(study->mean_strain, (std::array<double, 6>{0.01, 0, 0, 0, 0.5, 0}));
  const auto says = [](const std::string& text) {
    Diagnostics found;
    EXPECT_FALSE(study_of(text, found));
    return to_text(found);
  };
  EXPECT_NE(says(R"({"mean_strain": [0.01]})").find("expected 6 numbers for \"mean_strain\""), std::string::npos);
  EXPECT_NE(says(R"({"supports": [], "mean_strain": [0, 0, 0, 0, 0, 0]})").find("a cell that repeats has no supports"),
            std::string::npos);
  EXPECT_NE(says(R"({"physics": "heat", "mean_strain": [0, 0, 0, 0, 0, 0]})").find("is of mechanics"),
            std::string::npos);
}

TEST(Study, PropertiesHaveUnits) {
  Diagnostics diagnostics;
  const auto study = study_of(
      R"({"materials": {"Soft": {"modulus_mpa": 1.5, "poissons_ratio": 0.4, "density_kg_m3": 1100}}})", diagnostics);
  ASSERT_TRUE(study) << to_text(diagnostics);
  EXPECT_EQ(study->materials.at("soft"), (Elastic{1.5, 0.4, 1.1e-9}));
}

TEST(Study, ForcesAreSharedByArea) {
  Diagnostics diagnostics;
  const Model model = cube();
  const auto conditions = conditions_in(
      std::string("{") + held_below + R"(, "loads": [{"on": "zmax", "force_n": [1, 2, -16]}]})", model, diagnostics);
  ASSERT_TRUE(conditions) << to_text(diagnostics);
  EXPECT_EQ(conditions->displacements.size(), 27U);
  EXPECT_NEAR(length(sum(conditions->forces) - Vec3{1, 2, -16}), 0, 1e-12);
  // A corner of the four faces has a quarter of a face, the middle all four quarters.
  for (const Prescribed& force : conditions->forces) {
    if (force.axis != 2) continue;
    const Vec3 p = model.bricks.node(force.node);
    EXPECT_DOUBLE_EQ(force.value, (p.x == 1 ? 2 : 1) * (p.y == 1 ? 2 : 1) * -1.0);
  }
}

TEST(Study, PressurePushesInwardsAndWeightPullsAll) {
  Diagnostics diagnostics;
  const auto pressed = conditions_in(
      std::string("{") + held_below + R"(, "loads": [{"on": "xmax", "pressure_mpa": 0.5}]})", cube(), diagnostics);
  ASSERT_TRUE(pressed) << to_text(diagnostics);
  EXPECT_EQ(sum(pressed->forces), (Vec3{-2, 0, 0}));
  const auto heavy =
      conditions_in(std::string("{") + held_below + R"(, "gravity_mm_s2": [0, 0, -9810]})", cube(), diagnostics);
  ASSERT_TRUE(heavy);
  EXPECT_NEAR(sum(heavy->forces).z, -2e-9 * 8 * 9810, 1e-12);  // tonne mm/s2: N
}

TEST(Study, BoxesChooseNodesAndLaterSupportsCount) {
  Diagnostics diagnostics;
  const auto conditions = conditions_in(std::string("{") + R"("supports": [{"on": "zmin", "fix": "xyz"},
    {"on": {"box": [0, 0, 2, 0, 2, 2]}, "displacement_mm": [null, 0.5, null]},
    {"on": {"box": [0, 0, 0, 0, 0, 0]}, "displacement_mm": [0.1, null, null]}]})",
                                        cube(), diagnostics);
  ASSERT_TRUE(conditions) << to_text(diagnostics);
  EXPECT_EQ(conditions->displacements.size(), 30U);
  EXPECT_EQ(conditions->displacements.front().value, 0.1);
}

TEST(Study, WrongOnesAreReportedWithPlaceAndRemedy) {
  EXPECT_NE(complaint("[]").find("expected a study in braces"), std::string::npos);
  EXPECT_NE(complaint(R"({"suports": []})").find("did you mean \"supports\"?"), std::string::npos);
  EXPECT_NE(complaint(R"({"supports": [{"on": "top", "fix": "z"}]})").find("there is no side \"top\""),
            std::string::npos);
  EXPECT_NE(complaint(R"({"supports": [{"fix": "z"}]})").find("needs \"on\""), std::string::npos);
  EXPECT_NE(complaint(R"({"supports": [{"on": "zmin", "fix": "w"}]})").find("expected axes"), std::string::npos);
  EXPECT_NE(complaint(R"({"supports": [{"on": "zmin"}]})").find("either \"fix\" or \"displacement_mm\""),
            std::string::npos);
  EXPECT_NE(complaint(R"({"loads": [{"on": "zmin"}]})").find("either \"force_n\" or \"pressure_mpa\""),
            std::string::npos);
  EXPECT_NE(complaint(R"({"loads": [{"on": {"box": [1, 0, 0, 0, 1, 1]}, "force_n": [1, 0, 0]}]})").find("empty"),
            std::string::npos);
  EXPECT_NE(
      complaint(R"({"materials": {"a": {"modulus_mpa": -1, "poissons_ratio": 0.3}}})").find("from 1e-09 to 1e+09"),
      std::string::npos);
  EXPECT_NE(complaint(R"({"materials": {"a": {"modulus_mpa": 1}}})").find("needs \"poissons_ratio\""),
            std::string::npos);
}

TEST(Study, LoosePartsAndEmptySelectionsAreErrors) {
  const auto error = [](const std::string& text, const Model& model) {
    Diagnostics diagnostics;
    EXPECT_FALSE(conditions_in(text, model, diagnostics));
    return to_text(diagnostics);
  };
  EXPECT_NE(error("{}", cube()).find("free to move"), std::string::npos);
  // A cube that is held along z only may slide and turn about z; held in two corners, it may turn about the line
  // between them.
  EXPECT_NE(error(R"({"supports": [{"on": "zmin", "fix": "z"}]})", cube()).find("free to move"), std::string::npos);
  EXPECT_NE(error(R"({"supports": [{"on": {"box": [0, 0, 0, 2, 0, 0]}, "fix": "xyz"}]})", cube()).find("free to move"),
            std::string::npos);
  EXPECT_NE(error(R"({"supports": [{"on": {"box": [5, 5, 5, 6, 6, 6]}, "fix": "xyz"}]})", cube())
                .find("from (0, 0, 0) to (2, 2, 2) mm"),
            std::string::npos);
  const Model two = model_of(make_bricks({}, {1, 1, 1}, {{0, 0, 0}, {0, 0, 5}}), {1000, 0.3, 0});
  EXPECT_NE(error(std::string("{") + held_below + "}", two).find("1 of the mesh's 2 pieces"), std::string::npos);
}

// Returns the number of nodes that a selection chooses of a cube of 2 x 2 x 2 mm, and the message about a wrong one.
size_t chosen_by(const std::string& selection, const ModelView& model, std::string* complaint = nullptr) {
  Diagnostics diagnostics;
  const auto study =
      study_of(R"({"supports": [{"on": )" + selection + R"(, "fix": "xyz", "name": "here"}]})", diagnostics);
  const auto conditions = study ? conditions_of(*study, model, diagnostics) : std::nullopt;
  if (complaint) *complaint = to_text(diagnostics);
  if (!conditions) return 0;
  EXPECT_EQ(conditions->sets[0].name, "here");
  return conditions->sets[0].nodes.size();
}

TEST(Study, SelectionsCombine) {
  Model model = cube();
  model.sections.push_back({"soft", {1, 0.3, 0}});
  for (size_t n = 0; n < 4; ++n) model.section_of[n] = 1;  // the lower half
  EXPECT_EQ(chosen_by(R"({"plane": [1, 1, 1, 0, 0, 2]})", model), 9U);
  EXPECT_EQ(chosen_by(R"({"plane": [1, 0, 0, 1, 1, 0]})", model), 6U);  // x + y = 1
  EXPECT_EQ(chosen_by(R"({"facing": [0, 0, -1]})", model), 9U);
  EXPECT_EQ(chosen_by(R"({"facing": [1, 1, 0], "within_degrees": 50})", model), 15U);
  EXPECT_EQ(chosen_by(R"({"material": "Soft"})", model), 18U);
  EXPECT_EQ(chosen_by(R"({"material": "soft", "side": "xmax"})", model), 6U);
  std::string complaint;
  EXPECT_EQ(chosen_by(R"({"material": "sotf"})", model, &complaint), 0U);
  EXPECT_NE(complaint.find("no material \"sotf\""), std::string::npos);
  chosen_by(R"({"where": "z > 1"})", model, &complaint);
  EXPECT_NE(complaint.find("need the design"), std::string::npos);
  chosen_by(R"({"plane": [0, 0, 0, 0, 0, 0]})", model, &complaint);
  EXPECT_NE(complaint.find("no length"), std::string::npos);
  chosen_by(R"({"within_degrees": 20, "side": "xmin"})", model, &complaint);
  EXPECT_NE(complaint.find("needs \"facing\""), std::string::npos);
  chosen_by(R"({"plane": [9, 0, 0, 1, 0, 0]})", model, &complaint);
  EXPECT_NE(complaint.find("no node of the mesh lies there"), std::string::npos);
}

// A pressure on a chosen surface acts on its own sides, not on those that only share its nodes.
TEST(Study, PressureActsOnWhatFacesIt) {
  Diagnostics diagnostics;
  const auto pressed = conditions_in(
      std::string("{") + held_below + R"(, "loads": [{"on": {"facing": [0, 0, 1]}, "pressure_mpa": 0.5}]})", cube(),
      diagnostics);
  ASSERT_TRUE(pressed) << to_text(diagnostics);
  EXPECT_EQ(sum(pressed->forces), (Vec3{0, 0, -2}));
}

TEST(Study, ConductionHasWordsOfItsOwn) {
  EXPECT_NE(complaint(R"({"physics": "heat", "supports": [{"on": "zmin", "fix": "xyz"}]})").find("no \"fix\""),
            std::string::npos);
  EXPECT_NE(complaint(R"({"physics": "cold"})").find("no physics \"cold\""), std::string::npos);
  EXPECT_NE(complaint(R"({"physics": "heat", "supports": [{"on": "zmin"}]})").find("needs \"temperature_c\""),
            std::string::npos);
  EXPECT_NE(complaint(R"({"physics": "heat", "loads": [{"on": "zmin", "film_w_m2k": 5}]})").find("needs \"ambient_c\""),
            std::string::npos);
  EXPECT_NE(
      complaint(R"({"physics": "electric", "materials": {"a": {"conductivity_s_m": -1}}})").find("from 1e-12 to 1e+12"),
      std::string::npos);
  Diagnostics diagnostics;
  EXPECT_FALSE(conditions_in(R"({"physics": "heat", "loads": [{"on": "zmin", "heat_w": 5}]})", cube(), diagnostics));
  EXPECT_NE(to_text(diagnostics).find("nothing decides the temperature"), std::string::npos);
}

}  // namespace
}  // namespace ombre::fea
