#include "lang/syntax/declaration.h"

#include <gtest/gtest.h>

#include "base/text/text.h"
#include "lang/syntax/parser.h"

namespace ombre::lang {
namespace {

std::vector<Declaration> declared(const std::string& text, Diagnostics& diagnostics) {
  return declarations_of(parse(make_source("part.vcad", text), diagnostics));
}

std::vector<Declaration> declared(const std::string& text) {
  Diagnostics diagnostics;
  const std::vector<Declaration> result = declared(text, diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  return result;
}

constexpr const char* honeycomb = R"(
/// Hexagonal cells of a plane, with walls. Walls are shared:
/// two cells have one wall.
/// Category: decompose/lattice
/// Example: honeycomb_walls(size = 8);
/// Source: Foundry 2016, Fig. 9
module honeycomb_walls(
  size = 6,     // [1:0.5:20] mm: Width of a cell
  wall = (0.8), // [0.1:5] mm: Thickness of a wall
  core = "soft",// material: What fills the cells
  pattern = "planar", // [planar, "round one"] text: How cells lie
  place         // vector: Where the first cell lies
) { cube(size); }
)";

TEST(Declaration, ReadsBlockAndParameters) {
  const std::vector<Declaration> all = declared(honeycomb);
  ASSERT_EQ(all.size(), 1u);
  const Declaration& honey = all[0];
  EXPECT_EQ(honey.name, "honeycomb_walls");
  EXPECT_TRUE(honey.is_module);
  EXPECT_EQ(honey.sentence, "Hexagonal cells of a plane, with walls. Walls are shared: two cells have one wall.");
  EXPECT_EQ(honey.category, "decompose/lattice");
  EXPECT_EQ(honey.example, "honeycomb_walls(size = 8);");
  EXPECT_EQ(honey.source, "Foundry 2016, Fig. 9");
  ASSERT_EQ(honey.parameters.size(), 5u);
  const DeclaredParameter& size = honey.parameters[0];
  EXPECT_EQ(size.name, "size");
  EXPECT_EQ(size.type, "value");
  EXPECT_EQ(size.unit, "mm");
  EXPECT_EQ(size.sentence, "Width of a cell");
  EXPECT_EQ(size.default_text, "6");
  EXPECT_EQ(*size.value, Data(6.0));
  EXPECT_EQ(size.least, 1);
  EXPECT_EQ(size.step, 0.5);
  EXPECT_EQ(size.most, 20);
  EXPECT_EQ(honey.parameters[1].default_text, "(0.8)");
  EXPECT_EQ(honey.parameters[1].least, 0.1);
  EXPECT_FALSE(honey.parameters[1].step);
  EXPECT_EQ(honey.parameters[2].type, "material");
  ASSERT_EQ(honey.parameters[3].choices.size(), 2u);
  EXPECT_EQ(honey.parameters[3].choices[1].first, Data("round one"));
  EXPECT_EQ(honey.parameters[4].type, "vector");
  EXPECT_EQ(honey.parameters[4].default_text, "");
}

TEST(Declaration, ReadsOutputs) {
  const std::vector<Declaration> all = declared(R"(
    /// Cells.
    /// Returns: index vector, local vector, edges value mm,
    /// note
    function cells(size = 6) = object(index = [0, 0, 0]);
    /// Marble.
    /// Returns: mixture
    function marble(a, b = [1, 2], c = true) = a;
    /// A length.
    /// Returns: value mm
    function width() = 3;
  )");
  ASSERT_EQ(all.size(), 3u);
  const auto text = [](const std::vector<DeclaredOutput>& outputs) {
    std::string text;
    for (const DeclaredOutput& output : outputs) text += output.name + '/' + output.type + '/' + output.unit + ' ';
    return text;
  };
  EXPECT_EQ(text(all[0].outputs), "index/vector/ local/vector/ edges/value/mm note// ");
  EXPECT_EQ(text(all[1].outputs), "/mixture/ ");
  EXPECT_EQ(text(all[2].outputs), "/value/mm ");
  EXPECT_EQ(all[1].parameters[0].type, "");
  EXPECT_EQ(all[1].parameters[1].type, "vector");
  EXPECT_EQ(all[1].parameters[2].type, "truth");
}

TEST(Declaration, OnlyABlockRightAboveDeclares) {
  EXPECT_TRUE(declared("module plain(r = 5 // [0:3] mm: radius\n) {}").empty());
  EXPECT_TRUE(declared("/// far away\n\nmodule far() {}").empty());
  EXPECT_TRUE(declared("x = 1; /// behind\nmodule behind() {}").empty());
  EXPECT_TRUE(declared("/// above\nx = 1; module after() {}").empty());
  EXPECT_EQ(declared("///\nmodule empty() {}").size(), 1u);
  EXPECT_EQ(declared("/// ends with the file\r\nfunction f() = 1;\r\n").size(), 1u);
}

// A comment belongs to the last parameter of its line.
TEST(Declaration, CommentsBelongToTheirLine) {
  const std::vector<Declaration> all =
      declared("/// f\nfunction f(a = 1, b = 2, // mm: of b\n c = 3) = 1; // mm: no\n");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].parameters[0].unit, "");
  EXPECT_EQ(all[0].parameters[1].unit, "mm");
  EXPECT_EQ(all[0].parameters[1].sentence, "of b");
  EXPECT_EQ(all[0].parameters[2].unit, "");
}

TEST(Declaration, UnknownTypesAreWarnedOf) {
  Diagnostics diagnostics;
  const auto all = declared("/// f\nmodule f(a = 1 // nmuber: Width\n) {}", diagnostics);
  EXPECT_EQ(all[0].parameters[0].sentence, "nmuber: Width");
  const std::string expected =
      "part.vcad:2:18: warning: this comment declares the type or unit \"nmuber\", which is not known; types are "
      "number";
  EXPECT_EQ(to_text(diagnostics).substr(0, expected.size()), expected);
  Diagnostics none;
  declared("/// f\nmodule f(a = 1, // the width of a cell: in all places\n b = 2 // no colon at all\n) {}", none);
  EXPECT_EQ(to_text(none), "");
}

}  // namespace
}  // namespace ombre::lang
