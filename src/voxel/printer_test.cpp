#include "voxel/printer.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/system/test_source_files.h"

namespace ombre::voxel {
namespace {

namespace fs = std::filesystem;

const fs::path profiles = source_file("printers");

std::optional<Printer> shipped(const std::string& name, Diagnostics& diagnostics) {
  std::ifstream file(profiles / (name + ".json"));
  std::stringstream text;
  text << file.rdbuf();
  return parse_printer(make_source(name, text.str()), diagnostics);
}

Printer shipped(const std::string& name) {
  Diagnostics diagnostics;
  const auto printer = shipped(name, diagnostics);
  EXPECT_TRUE(printer) << to_text(diagnostics);
  return printer.value_or(Printer());
}

// Returns the messages for a complete profile with one member replaced or added.
std::string messages(const std::string& member) {
  const std::string text =
      R"({"title": "t", "source": "s", "image": "rgba", )" +
      (member.find("\"pitch\"") == std::string::npos ? std::string(R"("pitch": {"x": 0.1, "y": 0.1, "z": 0.1}, )")
                                                     : "") +
      (member.find("\"name\"") == std::string::npos ? std::string(R"("name": "p", )") : "") + member + "}";
  Diagnostics diagnostics;
  const auto printer = parse_printer(make_source("p.json", text), diagnostics);
  EXPECT_EQ(printer.has_value(), !diagnostics.has_errors());
  return to_text(diagnostics);
}

void expect_message(const std::string& member, const std::string& part) {
  const std::string text = messages(member);
  EXPECT_NE(text.find(part), std::string::npos) << member << "\ngave: " << text;
}

}  // namespace

TEST(Printer, SaysWhatItNeeds) {
  EXPECT_EQ(shipped("j750").needs, std::vector<std::string>{"fractions"});
  EXPECT_EQ(shipped("fff-foaming-pla").needs, (std::vector<std::string>{"temperature", "flow_rate"}));
  EXPECT_EQ(shipped("fff-foaming-pla").calibrations, std::vector<std::string>{"foaming-pla-flow"});
  expect_message(R"("needs": [])", "a printer needs something");
  expect_message(R"("calibrations": [3])", "expected a text");
}

TEST(Printer, SaysWhatItRounds) {
  ASSERT_EQ(shipped("fff-infill").steps.size(), 1U);
  EXPECT_EQ(shipped("fff-infill").steps[0].of, "infill_density");
  EXPECT_EQ(shipped("fff-infill").steps[0].size, 5);
  EXPECT_TRUE(shipped("j750").steps.empty());
  expect_message(R"("steps": {"dose": 1})", "\"steps\" has dose, which is not among the \"needs\"");
  expect_message(R"("steps": {"fractions": 0.3})", "1 is no multiple of 0.3, the step of fractions");
  expect_message(R"("steps": {"fractions": 0})", "a number above 0");
  expect_message(R"("steps": [0.5])", "\"steps\"");
}

TEST(Printer, AllShippedProfilesLoadUnderTheirFileNames) {
  size_t count = 0;
  for (const auto& entry : fs::directory_iterator(profiles)) {
    if (entry.path().extension() != ".json") continue;
    const std::string name = entry.path().stem().string();
    EXPECT_EQ(shipped(name).name, name);
    ++count;
  }
  EXPECT_GE(count, 6U);
}

TEST(Printer, PolyJetPitchesAreExactRatios) {
  const Printer j750 = shipped("j750");
  EXPECT_EQ(j750.pitch[0], (Pitch{127, 3000}));
  EXPECT_EQ(j750.pitch[1], (Pitch{127, 1500}));
  EXPECT_EQ(j750.pitch[2], (Pitch{27, 1000}));
  EXPECT_EQ(j750.build_mm, (Vec3{490, 390, 200}));
  EXPECT_EQ(j750.format, ImageFormat::rgba);
  EXPECT_EQ(j750.max_materials, 6);
  ASSERT_TRUE(j750.smallest_feature);
  EXPECT_EQ(j750.smallest_feature->fails_mm, 0.21);
}

TEST(Printer, GenericIsIndexedWithoutABuildBox) {
  const Printer generic = shipped("generic");
  EXPECT_EQ(generic.pitch[2], (Pitch{1, 10}));
  EXPECT_EQ(generic.format, ImageFormat::indexed);
  EXPECT_FALSE(generic.build_mm);
  EXPECT_EQ(generic.files.name(7), "slice_00007.png");
}

TEST(Printer, ReadsEveryMember) {
  Diagnostics diagnostics;
  const auto printer = parse_printer(make_source("p.json", R"({
    "name": "mine", "title": "t", "source": "s",
    "pitch": {"x": "25.4/600", "y": {"dpi": 300}, "z": 0.014},
    "build_mm": [10, 20, 30], "image": "indexed", "origin": "center", "flip": ["y", "x"],
    "background": [1, 2, 3, 4], "files": "L{index}.png", "first_index": 1, "empty_layers": "drop",
    "max_materials": 3, "smallest_feature": {"distorts_mm": 0.4, "fails_mm": 0.2},
    "forbidden_neighbours": [{"material": "liquid", "near": "surface", "within_mm": 0.3}]
  })"),
                                     diagnostics);
  ASSERT_TRUE(printer) << to_text(diagnostics);
  EXPECT_EQ(printer->pitch[0], (Pitch{127, 3000}));
  EXPECT_EQ(printer->pitch[2], (Pitch{7, 500}));
  EXPECT_EQ(printer->origin, Placement::center);
  EXPECT_TRUE(printer->flip_x && printer->flip_y && printer->drop_empty_layers);
  EXPECT_EQ(printer->background, (std::array<uint8_t, 4>{1, 2, 3, 4}));
  EXPECT_EQ(printer->files.name(12), "L12.png");
  EXPECT_EQ(printer->first_index, 1);
  EXPECT_EQ(printer->max_materials, 3);
  ASSERT_EQ(printer->forbidden_neighbours.size(), 1U);
  EXPECT_EQ(printer->forbidden_neighbours[0].near, "surface");
}

TEST(Printer, WrongProfilesAreExplained) {
  expect_message(R"("origen": "center")", "did you mean \"origin\"?");
  expect_message(R"("first_index": 0.5)", "expected a whole number from 0 to 1000000000 for \"first_index\", not 0.5");
  expect_message(R"("origin": "middle")", "there is no origin \"middle\"; write one of \"design\", \"center\"");
  expect_message(R"("origin": "center")", "needs \"build_mm\"");
  expect_message(R"("build_mm": [1, 2])",
                 "expected 3 numbers for \"build_mm\", not a list of 2; write [x, y, z] in mm");
  expect_message(R"("build_mm": [1, 2, -3])", "a number above 0 for \"build_mm\", not -3");
  expect_message(R"("flip": ["z"])", "expected \"x\" or \"y\"");
  expect_message(R"("background": [0, 0, 256, 0])", "from 0 to 255");
  expect_message(R"("files": "slice.png")", "slice_{index:05}.png");
  expect_message(R"("files": "../{index}.png")", "not a pattern for file names");
  expect_message(R"("max_materials": 300)", "from 1 to 255");
  expect_message(R"("smallest_feature": {"distorts_mm": 0.2, "fails_mm": 0.4})", "must not be above");
  expect_message(R"("pitch": {"x": "wide", "y": 0.1, "z": 0.1})", "this is not a pitch");
  expect_message(R"("pitch": {"x": {"dip": 600}, "y": 0.1, "z": 0.1})", "did you mean \"dpi\"?");
  expect_message(R"("pitch": {"x": 0.1, "y": 0.1})", "\"pitch\" needs \"z\"");
  expect_message(R"("name": "J 750")", "lower-case letters");
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_printer(make_source("p.json", "[]"), diagnostics));
  EXPECT_NE(to_text(diagnostics).find("expected a printer profile in braces"), std::string::npos);
}

TEST(NamePattern, NamesAndIndicesBelongTogether) {
  const auto pattern = NamePattern::parse("slice_{index:05}.png");
  ASSERT_TRUE(pattern);
  EXPECT_EQ(pattern->text(), "slice_{index:05}.png");
  EXPECT_EQ(pattern->name(123456), "slice_123456.png");
  for (const int64_t index : {0, 7, 99999, 100000}) EXPECT_EQ(pattern->index(pattern->name(index)), index);
  for (const char* other :
       {"slice_7.png", "slice_0000a.png", "slice_.png", "slice_-0001.png", "slice_00007.png.part", "x"})
    EXPECT_FALSE(pattern->index(other)) << other;
  for (const char* wrong : {"a{index:5}.png", "a{index:00}.png", "{index}.tif", ".{index}.png", "a/{index}.png",
                            "{index", "{index}{index}.png", "{index}{material}.png", "{material}7{index}.png",
                            "{index}_{material}_{material}.png", "{material}.png", "{material}/{index}.png"})
    EXPECT_FALSE(NamePattern::parse(wrong)) << wrong;
}

TEST(NamePattern, MaterialsHaveFilesOfTheirOwn) {
  for (const char* text :
       {"slice_{index:05}_{material}.png", "{material}-{index}.png", "a{material}_7_{index:02}.png"}) {
    const auto pattern = NamePattern::parse(text);
    ASSERT_TRUE(pattern) << text;
    EXPECT_TRUE(pattern->has_material());
    EXPECT_EQ(pattern->text(), text);
    EXPECT_EQ(pattern->with_material(), *pattern);
    // The pattern of one material matches only the names of that material.
    for (const char* material : {"red", "5", "05_5"}) {
      const NamePattern own = pattern->of_material(material);
      EXPECT_FALSE(own.has_material());
      EXPECT_EQ(own.index(own.name(17)), 17);
      for (const char* other : {"green", "55", "5_5"}) EXPECT_FALSE(pattern->of_material(other).index(own.name(17)));
    }
  }
  const auto plain = NamePattern::parse("slice_{index:05}.png");
  EXPECT_FALSE(plain->has_material());
  EXPECT_EQ(plain->of_material("red"), *plain);
  EXPECT_EQ(plain->with_material().text(), "slice_{index:05}_{material}.png");
}

}  // namespace ombre::voxel
