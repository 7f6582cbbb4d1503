// Checks one message in each language and front end.
#include "base/text/phrase.h"

#include <gtest/gtest.h>

namespace ombre {
namespace {

std::string in(const Phrase& phrase, Language language) { return phrase.in({language, FrontEnd::command_line}); }

}  // namespace

TEST(Phrase, TextsStayAsTheyAre) {
  const Phrase phrase = "choose " + Phrase("larger ") + std::string("voxels");
  for (const Language language : {Language::script, Language::json, Language::python, Language::openscad})
    EXPECT_EQ(in(phrase, language), "choose larger voxels");
  EXPECT_TRUE(Phrase().empty());
  EXPECT_TRUE(Phrase("").empty());
  EXPECT_TRUE((Phrase("") + std::string()).empty());
}

TEST(Phrase, CallsOfNodes) {
  const Phrase named = spelled::call("union", {{"blend", "1"}, {"materials", "\"blend\""}});
  EXPECT_EQ(in(named, Language::script), R"(union(blend=1, materials="blend"))");
  EXPECT_EQ(in(named, Language::openscad), R"(union(blend=1, materials="blend"))");
  EXPECT_EQ(in(named, Language::python), R"(ombre.union(blend=1, materials="blend"))");
  EXPECT_EQ(in(named, Language::json), R"({"type": "union", "parameters": {"blend": 1, "materials": "blend"}})");
  EXPECT_EQ(in(spelled::call("sphere"), Language::json), R"({"type": "sphere"})");
  // Design files have no positional arguments.
  EXPECT_EQ(in(spelled::call("sphere", {{"", "5"}}), Language::json), R"({"type": "sphere", "parameters": {...}})");
}

TEST(Phrase, NodesAroundSolids) {
  const Phrase phrase = "put it into " + spelled::around("tile");
  EXPECT_EQ(in(phrase, Language::script), "put it into tile(...) { ... }");
  EXPECT_EQ(in(phrase, Language::python), "put it into ombre.tile(solid, ...)");
  EXPECT_EQ(in(phrase, Language::json), R"(put it into {"type": "tile", "parameters": {...}, "inputs": [...]})");
}

TEST(Phrase, VectorsHaveBracketsWhereTheLanguageKnowsNoOthers) {
  const Phrase phrase = spelled::parameter("spacing", "(0.5, 0.5, 1)");
  EXPECT_EQ(in(phrase, Language::script), "spacing=(0.5, 0.5, 1)");
  EXPECT_EQ(in(phrase, Language::python), "spacing=(0.5, 0.5, 1)");
  EXPECT_EQ(in(phrase, Language::openscad), "spacing=[0.5, 0.5, 1]");
  EXPECT_EQ(in(phrase, Language::json), R"("spacing": [0.5, 0.5, 1])");
  // The parentheses of calls and of quoted texts stay.
  EXPECT_EQ(in(spelled::value(R"v([(1, 2), f(3, (4, 5)), "(6)"])v"), Language::json),
            R"v([[1, 2], f(3, [4, 5]), "(6)"])v");
}

TEST(Phrase, OptionsOfJobs) {
  const Phrase phrase = spelled::option("--layer-height", "0.1") + " or " + spelled::option("--cell") + " with " +
                        spelled::option("--place", "center");
  EXPECT_EQ(phrase.text(), "--layer-height 0.1 or --cell with --place center");
  EXPECT_EQ(phrase.in({Language::script, FrontEnd::python}), R"(layer_height=0.1 or cell with place="center")");
  EXPECT_EQ(phrase.in({Language::script, FrontEnd::studio}), "layer height 0.1 or cell with place center");
}

TEST(Phrase, VariablesOfDesigns) {
  const Phrase phrase = spelled::assignment("width", "1");
  EXPECT_EQ(in(phrase, Language::script), "width = 1;");
  EXPECT_EQ(in(phrase, Language::openscad), "width = 1;");
  EXPECT_EQ(in(phrase, Language::python), "width = 1");
}

TEST(Phrase, TheDesignsNameSaysItsLanguage) {
  const auto language = [](const char* name, FrontEnd front_end) { return wording_of(name, front_end).language; };
  EXPECT_EQ(language("a.vcad", FrontEnd::python), Language::script);
  EXPECT_EQ(language("a.json", FrontEnd::command_line), Language::json);
  EXPECT_EQ(language("a.scad", FrontEnd::studio), Language::openscad);
  EXPECT_EQ(language("a.py", FrontEnd::command_line), Language::python);
  EXPECT_EQ(language("", FrontEnd::command_line), Language::script);
  EXPECT_EQ(language("<ipython-input-3>", FrontEnd::python), Language::python);
}

}  // namespace ombre
