#include "studio/workspace/presets.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/test_errors.h"
#include "studio/workspace/test_folder.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

const DataMembers values{{"width", 7.5}, {"name", "5\" µ"}, {"is_round", true}, {"size", DataList{1.0, 2.0, 3.0}}};

Data parsed(const std::string& text) {
  Diagnostics diagnostics;
  const auto data = parse_json(make_source("presets", text), diagnostics);
  EXPECT_TRUE(data) << text;
  return data.value_or(Data());
}

TEST(Presets, HaveTheFormOfOpenScad) {
  const TestFolder folder;
  const Workspace workspace(folder.path);
  Presets presets(workspace);
  EXPECT_TRUE(presets.list("part.scad").empty());
  const DataList saved = presets.save("part.scad", "small", values, false);
  const Data expected = parsed(
      R"({"parameterSets": {"small": {"width": "7.5", "name": "5\" µ", "is_round": "true", "size": "[1, 2, 3]"}},
          "fileFormatVersion": "1"})");
  EXPECT_EQ(parsed(folder.read("part.json")), expected) << folder.read("part.json");
  EXPECT_EQ(presets.list("part.scad"), saved);
  ASSERT_EQ(saved.size(), 1U);
  EXPECT_EQ(*saved[0].find("values"), *expected.find("parameterSets")->find("small"));

  folder.write("parts/part.vcad", "");
  presets.save("parts/part.vcad", "big", values, false);
  EXPECT_TRUE(fs::exists(folder.path / "parts/part.presets.json"));
}

TEST(Presets, AreReplacedWhenThatIsMeant) {
  const TestFolder folder;
  const Workspace workspace(folder.path);
  Presets presets(workspace);
  for (const char* name : {"a", "b", "c"}) presets.save("part.vcad", name, values, false);
  EXPECT_EQ(code_of([&] { presets.save("part.vcad", "b", {{"width", 1.0}}, false); }), "exists");
  EXPECT_EQ(presets.list("part.vcad")[1].find("values")->members()->size(), values.size());
  presets.save("part.vcad", "b", {{"width", 1.0}}, true);
  EXPECT_EQ(*presets.list("part.vcad")[1].find("values"), Data(DataMembers{{"width", "1"}}));
  EXPECT_EQ(presets.remove("part.vcad", "a").size(), 2U);
  EXPECT_EQ(code_of([&] { presets.remove("part.vcad", "a"); }), "gone");
  EXPECT_EQ(*presets.list("part.vcad")[0].find("name"), Data("b"));
}

TEST(Presets, KeepWhatOthersWrote) {
  const TestFolder folder;
  const std::string by_others = R"({"fileFormatVersion": "1", "parameterSets": {"x": {"w": 3}}, "note": [1, null]})";
  folder.write("part.json", by_others);
  const Workspace workspace(folder.path);
  Presets presets(workspace);
  EXPECT_EQ(*presets.list("part.scad")[0].find("values"), Data(DataMembers{{"w", "3"}}));
  presets.save("part.scad", "y", {}, false);
  presets.remove("part.scad", "y");
  EXPECT_EQ(parsed(folder.read("part.json")), parsed(by_others));
}

TEST(Presets, LeaveFilesOfOtherFormatsAsTheyAre) {
  const TestFolder folder;
  const Workspace workspace(folder.path);
  Presets presets(workspace);
  for (const std::string text :
       {"", "no JSON", "[]", R"({"format": "ombre design", "nodes": []})", R"({"parameterSets": [1]})",
        R"({"parameterSets": {"a": 1}})", R"({"parameterSets": {}, "fileFormatVersion": "2"})"}) {
    folder.write("part.json", text);
    EXPECT_EQ(code_of([&] { presets.list("part.scad"); }), "format") << text;
    EXPECT_EQ(code_of([&] { presets.save("part.scad", "small", values, true); }), "format") << text;
    EXPECT_EQ(code_of([&] { presets.remove("part.scad", "a"); }), "format") << text;
    EXPECT_EQ(folder.read("part.json"), text);
  }
}

TEST(Presets, AreBounded) {
  const TestFolder folder;
  const Workspace workspace(folder.path);
  Presets presets(workspace);
  for (const std::string& name : {std::string(), std::string("  "), std::string("a\nb"), std::string(101, 'a')})
    EXPECT_EQ(code_of([&] { presets.save("part.vcad", name, values, false); }), "name") << name;
  for (const Data& value : {Data(), Data(DataMembers{}), Data(DataList{"a"}), Data(1 / 0.0)})
    EXPECT_EQ(code_of([&] { presets.save("part.vcad", "a", {{"v", value}}, false); }), "request");
  const Data large(std::string(Presets::most_bytes, 'x'));
  EXPECT_EQ(code_of([&] { presets.save("part.vcad", "a", {{"v", large}}, false); }), "size");
  EXPECT_FALSE(fs::exists(folder.path / "part.presets.json"));

  std::string many = R"({"parameterSets": {"0": {})";
  for (size_t n = 1; n < Presets::most; ++n) many += ", \"" + std::to_string(n) + "\": {}";
  folder.write("part.presets.json", many + "}}");
  EXPECT_EQ(code_of([&] { presets.save("part.vcad", "one more", values, false); }), "size");
  EXPECT_EQ(presets.save("part.vcad", "7", values, true).size(), Presets::most);
  folder.write("part.presets.json", std::string(Presets::most_bytes + 1, ' '));
  EXPECT_EQ(code_of([&] { presets.list("part.vcad"); }), "size");
}

TEST(Presets, StayInTheFolder) {
  const TestFolder folder;
  folder.write("theirs.json", R"({"parameterSets": {}})");
  fs::create_directory(folder.path / "shown");
  fs::create_symlink(folder.path / "theirs.json", folder.path / "shown/part.json");
  const Workspace workspace(folder.path / "shown");
  Presets presets(workspace);
  EXPECT_EQ(code_of([&] { presets.save("../part.vcad", "a", values, false); }), "name");
  EXPECT_EQ(code_of([&] { presets.save("part.scad", "a", values, false); }), "name");
  EXPECT_EQ(folder.read("theirs.json"), R"({"parameterSets": {}})");
}

TEST(Presets, SayWhereNothingCanBeWritten) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere: the read-only folder is not tried";
  const TestFolder folder;
  const Workspace workspace(folder.path);
  Presets presets(workspace);
  presets.save("part.vcad", "a", values, false);
  const std::string before = folder.read("part.presets.json");
  fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
  const std::string message = failure_of([&] { presets.save("part.vcad", "b", values, false); });
  fs::permissions(folder.path, fs::perms::owner_all);
  EXPECT_NE(message.find("choose a folder that you may write to"), std::string::npos) << message;
  EXPECT_EQ(folder.read("part.presets.json"), before);
}

TEST(Presets, AreNoDesigns) {
  const TestFolder folder;
  const Workspace workspace(folder.path);
  Presets presets(workspace);
  folder.write("a.vcad", "sphere(3, red);");
  folder.write("b.scad", "cube(3);");
  folder.write("c.scad", "cube(3);");
  folder.write("c.json", R"({"format": "a design of that name"})");
  presets.save("a.vcad", "small", values, false);
  presets.save("b.scad", "small", values, false);
  EXPECT_EQ(workspace.list(), (std::vector<std::string>{"a.vcad", "b.scad", "c.json", "c.scad"}));
}

}  // namespace
}  // namespace ombre::studio
