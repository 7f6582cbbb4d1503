#include "design/materials.h"

#include <gtest/gtest.h>

#include "base/text/json.h"

namespace ombre::design {
namespace {

std::optional<MaterialTable> table_of(const std::string& text, Diagnostics& diagnostics) {
  const auto data = parse_json(make_source("m", text), diagnostics);
  return data ? MaterialTable::read(*data, diagnostics) : std::nullopt;
}

MaterialTable table_of(const std::string& entries) {
  Diagnostics diagnostics;
  const auto table = table_of("{\"materials\": [" + entries + "]}", diagnostics);
  EXPECT_TRUE(table) << to_text(diagnostics);
  return table.value_or(MaterialTable());
}

// Returns the places and sentences of all messages.
std::string problems(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(table_of(text, diagnostics));
  std::string found;
  for (const Diagnostic& diagnostic : diagnostics.list()) {
    const Place place = diagnostic.where.source->place(diagnostic.where.begin);
    found += std::to_string(place.line) + ':' + std::to_string(place.column) + ": " + sentence_of(diagnostic) + '\n';
  }
  return found;
}

std::string problems_of_entry(const std::string& entry) { return problems("{\"materials\": [\n" + entry + "]}"); }

const std::string red = R"({"name": "red", "r": 255, "g": 0, "b": 0})";

TEST(Materials, AreNumberedAndKeepTheirOtherMembers) {
  const MaterialTable table = table_of(R"({"name": "Void", "r": 9, "g": 9, "b": 9, "why": "pores"}, )" + red +
                                       R"(, {"density": 1.2, "name": "soft", "r": 1, "g": 2, "b": 3, "a": 4, "E": 7})");
  ASSERT_EQ(table.names(), (std::vector<std::string>{"void", "red", "soft"}));
  EXPECT_EQ(table.find("VOID")->colour, (Rgba{0, 0, 0, 0}));
  EXPECT_EQ(table.find("void")->properties, (DataMembers{{"why", "pores"}}));
  EXPECT_EQ(table.find(1)->colour, (Rgba{255, 0, 0, 255}));
  EXPECT_EQ(table.find("soft")->id, 2);
  EXPECT_EQ(table.find("soft")->colour, (Rgba{1, 2, 3, 4}));
  EXPECT_EQ(table.find("soft")->properties, (DataMembers{{"density", 1.2}, {"E", 7.0}}));
  EXPECT_EQ(table.support(), nullptr);
  EXPECT_EQ(print_json_line(table.to_data()), R"({"materials":[{"name":"red","r":255,"g":0,"b":0,"a":255},)"
                                              R"({"name":"soft","r":1,"g":2,"b":3,"a":4,"density":1.2,"E":7}]})");
}

TEST(Materials, SupportsAreMadeOfTheMarkedOneOrTheOneOfThatName) {
  const std::string support = R"(, {"name": "Support", "r": 1, "g": 1, "b": 1, "support": false})";
  EXPECT_EQ(table_of(red + support).support()->name, "Support");
  EXPECT_EQ(table_of(R"({"name": "wax", "r": 1, "g": 1, "b": 1, "support": true})" + support).support()->name, "wax");
  EXPECT_EQ(print_json_line(table_of(red + support).find("support")->properties), R"({"support":false})");
}

TEST(Materials, WrongFilesAreExplained) {
  EXPECT_EQ(problems("[]"), R"(1:1: a design or a file of materials needs "materials"; write for example )"
                            R"("materials": [{"name": "red", "r": 255, "g": 0, "b": 0}])"
                            "\n");
  EXPECT_EQ(problems(R"({"materials": {}})"),
            "1:15: expected a list for \"materials\", in square brackets, not an object\n");
  EXPECT_EQ(problems(R"({"materials": []})"), "1:15: this file defines no material\n");
  EXPECT_EQ(problems_of_entry("3"),
            "2:1: expected a material in braces, not 3; its members are name, r, g, b, a, support\n");
  EXPECT_EQ(problems_of_entry(R"({"name": 1, "r": 0, "g": 256, "b": 0.5, "a": "x"})"),
            "2:10: expected a text for \"name\", not 1\n"
            "2:26: expected a whole number from 0 to 255 for \"g\", not 256\n"
            "2:36: expected a whole number from 0 to 255 for \"b\", not 0.5\n"
            "2:47: expected a whole number from 0 to 255 for \"a\", not the text \"x\"\n");
  EXPECT_EQ(problems_of_entry(R"({"r": 0, "g": 0})"),
            "2:1: a material needs \"name\"; write for example \"name\": \"red\"\n"
            "2:1: a material needs \"b\"; give r, g, b (and a) from 0 to 255\n");
  EXPECT_EQ(problems_of_entry(R"({"name": "wax", "r": 0, "g": 0, "b": 0, "suport": true})"),
            "2:51: a material has no \"suport\"; did you mean \"support\"?\n");
  EXPECT_EQ(problems_of_entry(red + ",\n" + red), "3:11: the material \"red\" is defined twice\n");
}

TEST(Materials, AreAtMost255) {
  std::string entries;
  for (int n = 0; n < 255; ++n) entries += R"({"name": "m)" + std::to_string(n) + R"(", "r": 0, "g": 0, "b": 0}, )";
  EXPECT_EQ(table_of(entries + R"({"name": "void", "r": 0, "g": 0, "b": 0})").all().size(), 256U);
  EXPECT_EQ(problems_of_entry(entries + "\n" + red), "3:1: a file may define at most 255 materials\n");
}

}  // namespace
}  // namespace ombre::design
