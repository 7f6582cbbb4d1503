// Tests of the files that slicers read besides the mesh.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/text/json.h"
#include "formats/mesh/test_documents.h"
#include "formats/slicers/bambu_project.h"
#include "formats/slicers/height_ranges.h"
#include "formats/slicers/known_keys.h"
#include "formats/slicers/painting.h"
#include "formats/slicers/project_filaments.h"
#include "formats/slicers/prusa_project.h"
#include "formats/slicers/slicer_settings.h"
#include "formats/slicers/snapmaker_mixtures.h"

namespace ombre::formats {
namespace {

using namespace test;

// The codes are those that PrusaSlicer and Bambu Studio write for whole triangles.
TEST(Painting, CodesOfWholeTriangles) {
  EXPECT_EQ(paint_code(1), "4");
  EXPECT_EQ(paint_code(2), "8");
  EXPECT_EQ(paint_code(3), "0C");
  EXPECT_EQ(paint_code(4), "1C");
  EXPECT_EQ(paint_code(16), "DC");
  for (uint32_t extruder = 1; extruder <= most_painted; ++extruder) {
    const auto paint = read_paint(paint_code(extruder));
    ASSERT_TRUE(paint);
    EXPECT_EQ(paint->extruder, extruder);
    EXPECT_FALSE(paint->is_divided);
  }
}

TEST(Painting, DividedTrianglesHaveTheirLargestPart) {
  EXPECT_TRUE(read_paint("841")->is_divided);
  EXPECT_FALSE(read_paint("441")->is_divided);
  // The fourth of these quarters is cut in two: its one half has extruder 1, all else extruder 2.
  EXPECT_EQ(read_paint("8888413")->extruder, 2u);
  EXPECT_EQ(read_paint("00EC")->extruder, 17u);
  for (const char* wrong : {"", "1", "G", "C", "44"}) EXPECT_FALSE(read_paint(wrong)) << wrong;
}

TEST(Settings, HaveTheNamesOfTheirSlicer) {
  EXPECT_EQ(key_in(SlicerFlavour::bambu, "infill_speed"), "sparse_infill_speed");
  EXPECT_EQ(key_in(SlicerFlavour::orca, "fuzzy_skin_point_dist"), "fuzzy_skin_point_distance");
  EXPECT_EQ(key_in(SlicerFlavour::bambu, "sparse_infill_density"), "sparse_infill_density");
  EXPECT_EQ(key_in(SlicerFlavour::prusa, "sparse_infill_density"), "");
  EXPECT_EQ(key_in(SlicerFlavour::orca, "gyroid_optimized"), "gyroid_optimized");
  EXPECT_EQ(key_in(SlicerFlavour::bambu, "gyroid_optimized"), "");
  EXPECT_EQ(key_in(SlicerFlavour::prusa, ""), "");
  EXPECT_EQ(scope_of(SlicerFlavour::bambu, "layer_height"), KeyScope::object);
  EXPECT_EQ(scope_of(SlicerFlavour::prusa, "fill_density"), KeyScope::body);
  EXPECT_FALSE(scope_of(SlicerFlavour::prusa, "temperature"));
  EXPECT_FALSE(scope_of(SlicerFlavour::prusa, "fill"));
  ASSERT_TRUE(slicer_key_of("infill_density"));
  EXPECT_EQ(slicer_key_of("infill_density")->prusa, "fill_density");
  EXPECT_FALSE(slicer_key_of("modulus"));
  EXPECT_FALSE(slicer_key_of(""));
}

TEST(Settings, TakeNumbersOfTheirKind) {
  const auto takes = [](SlicerFlavour flavour, const char* key, double number, const char* unit = "") {
    const ValueKind* const kind = kind_of(flavour, key);
    return kind && kind->takes(number, unit);
  };
  for (const SlicerFlavour flavour : {SlicerFlavour::prusa, SlicerFlavour::orca}) {
    const bool is_prusa = flavour == SlicerFlavour::prusa;
    const char* const walls = is_prusa ? "perimeters" : "wall_loops";
    EXPECT_TRUE(takes(flavour, walls, 0) && takes(flavour, walls, 3)) << walls;
    EXPECT_FALSE(takes(flavour, walls, -3) || takes(flavour, walls, 2.5) || takes(flavour, walls, 3, "%")) << walls;
    const char* const density = is_prusa ? "fill_density" : "sparse_infill_density";
    EXPECT_TRUE(takes(flavour, density, 100, "%") && takes(flavour, density, 20)) << density;
    EXPECT_FALSE(takes(flavour, density, 900, "%") || takes(flavour, density, -1, "%")) << density;
    EXPECT_TRUE(takes(flavour, "layer_height", 0.2));
    EXPECT_FALSE(takes(flavour, "layer_height", 0) || takes(flavour, "layer_height", 0.2, "mm"));
  }
  EXPECT_TRUE(takes(SlicerFlavour::prusa, "fill_angle", -45));
  EXPECT_TRUE(takes(SlicerFlavour::prusa, "extrusion_width", 105, "%"));
  EXPECT_FALSE(kind_of(SlicerFlavour::prusa, "fill_pattern"));
  EXPECT_FALSE(kind_of(SlicerFlavour::prusa, "sparse_infill_density"));
  EXPECT_FALSE(scope_of(SlicerFlavour::prusa, "perimeters#"));
}

// A key of the table that a program does not know would be lost.
TEST(Settings, KnowTheKeysOfTheirTable) {
  for (const SlicerKey& row : slicer_keys()) {
    EXPECT_TRUE(row.prusa.empty() || scope_of(SlicerFlavour::prusa, row.prusa)) << row.prusa;
    for (const SlicerFlavour flavour : {SlicerFlavour::bambu, SlicerFlavour::orca, SlicerFlavour::snapmaker})
      EXPECT_TRUE(row.bambu.empty() || scope_of(flavour, row.bambu)) << row.bambu;
  }
}

TEST(Filaments, AreThoseOfTheBodies) {
  MeshDocument document = pair();
  EXPECT_EQ(project_filaments(document)[1].name, "clear blue");
  document.bodies[1].settings = {{"extruder", "4"}};
  const std::vector<Filament> filaments = project_filaments(document);
  ASSERT_EQ(filaments.size(), 4u);
  EXPECT_EQ(filaments[0].name, "red");
  EXPECT_EQ(filaments[2].name, "filament 3");
  EXPECT_EQ(filaments[3].name, "clear blue");
}

TEST(Filaments, TypesAreWordsOfNames) {
  EXPECT_EQ(filament_type({"PETG black"}), "PETG");
  EXPECT_EQ(filament_type({"soft TPU 85A"}), "TPU");
  EXPECT_EQ(filament_type({"PAPER"}), "PLA");
  EXPECT_EQ(filament_type({"red"}), "PLA");
}

MeshDocument mixed() {
  MeshDocument document = pair();
  document.project.filaments = {{"red", {255, 0, 0, 255}}, {"blue", {0, 0, 255, 255}}};
  document.project.mixtures = {{"1 to 2", {85, 0, 170, 255}, {{1, 1}, {2, 2}}}};
  return document;
}

Data parsed(const std::string& text) {
  Diagnostics diagnostics;
  return parse_json(make_source("json", text), diagnostics).value();
}

TEST(PrusaProject, HasAValueForEachFilament) {
  const std::string text = prusa_project(mixed());
  EXPECT_NE(text.find("; nozzle_diameter = 0.4,0.4\n"), std::string::npos) << text;
  EXPECT_NE(text.find("; filament_colour = #FF0000;#0000FF\n"), std::string::npos);
  EXPECT_NE(text.find("; filament_settings_id = \"red\";\"blue\"\n"), std::string::npos);
}

TEST(PrusaProject, MixturesAreVirtualExtruders) {
  const Data json = parsed(prusa_mixtures(mixed()));
  EXPECT_EQ(*json.find("version")->number(), 1);
  const Data& mixture = json.find("virtual_extruders")->list()->at(0);
  EXPECT_EQ(*mixture.find("id")->number(), 3);
  EXPECT_EQ(*mixture.find("kind")->string(), "fullspectrum");
  EXPECT_EQ(*mixture.find("components")->list()->at(1).find("ratio")->number(), 2);
}

TEST(BambuProject, MixturesAreFilaments) {
  const Data json = parsed(bambu_project(mixed(), SlicerFlavour::bambu));
  const auto values = [&](const char* key) {
    std::string all;
    for (const Data& value : *json.find(key)->list()) all += *value.string() + '|';
    return all;
  };
  EXPECT_EQ(values("filament_colour"), "#FF0000|#0000FF|#5500AA|");
  EXPECT_EQ(values("filament_is_mixed"), "0|0|1|");
  EXPECT_EQ(values("filament_mixed_components"), "||1,2|");
  EXPECT_EQ(values("filament_mixed_sublayer_ratios"), "||0.3333,0.6667|");
  EXPECT_FALSE(parsed(bambu_project(pair(), SlicerFlavour::bambu)).find("filament_is_mixed"));
}

// Members of a row as files of Snapmaker Orca 2.3 have them: "1,3,1,1,40,0,g,w,m2,z0,xa0,xb0,d0,o0,u2" is a recipe with
// 40 % of filament 3, and "1,2,0,0,50,0,g,w,m2,z0,xa0,xb0,d1,o1,u1" a pair of its own that was deleted. A pattern comes
// last; 1 and 2 stand for the first and the second filament of the row.
TEST(SnapmakerProject, MixturesAreRowsOfAText) {
  MeshDocument document = mixed();
  document.project.mixtures.push_back({"3 to 2", {153, 0, 102, 255}, {{1, 3}, {2, 2}}});
  const Data json = parsed(bambu_project(document, SlicerFlavour::snapmaker));
  EXPECT_EQ(*json.find("mixed_filament_definitions")->string(),
            "1,2,1,1,67,0,g,w,m2,z0,xa0,xb0,d0,o0,u1,221;"
            "1,2,1,1,40,0,g,w,m2,z0,xa0,xb0,d0,o0,u2,21211;"
            "1,2,0,0,50,0,g,w,m2,z0,xa0,xb0,d1,o1,u3");
  // The text numbers mixtures after the filaments, so that they are no filaments themselves.
  EXPECT_EQ(json.find("filament_colour")->list()->size(), 2U);
  EXPECT_FALSE(json.find("filament_is_mixed"));
  EXPECT_EQ(bambu_version(document, SlicerFlavour::snapmaker), "02.00.00.00");
  EXPECT_FALSE(parsed(bambu_project(pair(), SlicerFlavour::snapmaker)).find("mixed_filament_definitions"));
}

// The program counts how often a filament occurs in the pattern.
TEST(SnapmakerProject, PatternsHaveTheSharesOfTheirMixtures) {
  for (int layers = 2; layers <= 6; ++layers)
    for (int first = 1; first < layers; ++first) {
      const std::vector<FilamentMixture> one{{"", {}, {{1, first}, {2, layers - first}}}};
      const std::string text = snapmaker_mixtures(one), row = text.substr(0, text.find(';'));
      const std::string pattern = row.substr(row.rfind(',') + 1);
      EXPECT_EQ(pattern.size(), static_cast<size_t>(layers));
      EXPECT_EQ(std::ranges::count(pattern, '1'), first) << pattern;
      EXPECT_EQ(std::ranges::count(pattern, '2'), layers - first) << pattern;
    }
}

// The numbers 1 and 2 of a pattern stand for the filaments that begin the row, and greater ones for the filaments of
// these numbers (the programs' own tests: physical_filament_from_token).
TEST(SnapmakerProject, TheThirdFilamentHasItsOwnNumber) {
  const std::vector<FilamentMixture> one{{"", {}, {{2, 2}, {4, 1}, {5, 1}}}};
  const std::string text = snapmaker_mixtures(one), row = text.substr(0, text.find(';'));
  EXPECT_TRUE(row.starts_with("2,4,1,1,25,")) << row;  // one layer of four has the second filament
  const std::string pattern = row.substr(row.rfind(',') + 1);
  EXPECT_EQ(pattern.size(), 4U);
  EXPECT_EQ(std::ranges::count(pattern, '1'), 2);
  EXPECT_EQ(std::ranges::count(pattern, '2'), 1);
  EXPECT_EQ(std::ranges::count(pattern, '5'), 1);
  EXPECT_EQ(pattern.find("11"), std::string::npos) << "equal layers lie apart";
}

TEST(HeightRanges, HaveTheWordsOfTheirSlicer) {
  MeshDocument document = pair();
  EXPECT_EQ(height_ranges(document, SlicerFlavour::prusa, 1), "");
  document.project.ranges = {{0, 2.5, {{"fill_density", "10%"}, {"layer_height", "0.2"}}}};
  const std::string text = height_ranges(document, SlicerFlavour::orca, 3);
  EXPECT_NE(text.find("<object id=\"3\">\n<range min_z=\"0\" max_z=\"2.5\">"), std::string::npos) << text;
  EXPECT_NE(text.find("<option opt_key=\"sparse_infill_density\">10%</option>"), std::string::npos);
}

}  // namespace
}  // namespace ombre::formats
