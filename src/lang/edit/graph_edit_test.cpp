#include "lang/edit/graph_edit.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ombre::lang {
namespace {

// Returns the number of the item that calls a name, or of the variable with that name.
size_t item_called(const ScriptGraph& graph, const std::string& name) {
  const auto& items = graph.items();
  const auto found =
      std::ranges::find_if(items, [&](const GraphItem& item) { return item.callee == name || item.variable == name; });
  EXPECT_NE(found, items.end()) << name;
  return static_cast<size_t>(found - items.begin());
}

ScriptGraph graph_of(const std::string& text) {
  Diagnostics diagnostics;
  auto graph = ScriptGraph::read(make_source("part.vcad", text), Dialect::vcad, diagnostics);
  EXPECT_TRUE(graph) << to_text(diagnostics);
  return std::move(*graph);
}

// Returns the text after an edit, or why it was refused.
std::string after(const std::string& text, const GraphEdit& change) {
  Diagnostics diagnostics;
  const auto edited = edit(make_source("part.vcad", text), Dialect::vcad, change, diagnostics);
  return edited ? std::string(edited->text->text()) : sentence_of(diagnostics.list().front());
}

size_t in(const std::string& text, const std::string& name) { return item_called(graph_of(text), name); }

std::string set(const std::string& text, const std::string& item, std::optional<size_t> index, const std::string& name,
                const std::string& value) {
  return after(text, SetArgument{in(text, item), index, name, value});
}
std::string insert(const std::string& text, InsertCall::Where where, const std::string& item, const std::string& call) {
  return after(text, InsertCall{where, item.empty() ? 0 : in(text, item), call});
}
std::string remove(const std::string& text, const std::string& item, bool keeps_children) {
  return after(text, RemoveItem{in(text, item), keeps_children});
}
std::string move(const std::string& text, const std::string& item, const std::string& into) {
  return after(text, MoveCall{in(text, item), into.empty() ? std::nullopt : std::optional(in(text, into))});
}
std::string connect(const std::string& text, const std::string& from, const std::string& output, const std::string& to,
                    std::optional<size_t> index, const std::string& name) {
  return after(text, ConnectItems{in(text, from), output, {in(text, to), index, name, ""}});
}

using Where = InsertCall::Where;

TEST(ScriptGraph, ListsCallsVariablesAndWhatMakesThem) {
  const ScriptGraph graph = graph_of(
      "r = 2;\n"
      "c = cells((r, r, r));\n"
      "union() {\n"
      "  sphere(r);\n"
      "  for (i = [0 : 3]) translate(i, 0, 0) cube(c.distance);\n"
      "}\n");
  ASSERT_EQ(graph.items().size(), 7u);
  EXPECT_EQ(graph.items()[1].callee, "cells");
  EXPECT_EQ(graph.items()[1].variable, "c");
  EXPECT_EQ(graph.items()[3].callee, "sphere");
  EXPECT_EQ(graph.items()[3].parent, 2u);
  EXPECT_EQ(graph.items()[4].kind, GraphItem::Kind::group);
  EXPECT_EQ(graph.items()[6].locked_by, "a loop");
  EXPECT_FALSE(graph.items()[3].is_locked());
}

TEST(ScriptGraph, KnowsWhichVariablesArgumentsUse) {
  const ScriptGraph graph =
      graph_of("a = 2; c = hex_cells(a);\nsphere(\"a + x\", m = c.index); for (a = [1 : 2]) cube(a);");
  std::vector<std::string> wires;
  for (const Mention& mention : graph.mentions())
    if (mention.target)
      wires.push_back(mention.name + '.' + mention.output + " -> " + graph.items()[mention.item].callee +
                      (mention.is_whole ? " whole" : ""));
  EXPECT_EQ(wires, (std::vector<std::string>{"a. -> hex_cells whole", "a. -> sphere", "c.index -> sphere whole"}));
}

TEST(GraphEdit, SetsArguments) {
  EXPECT_EQ(set("sphere(5); // ball\n", "sphere", 0, "", "6.5"), "sphere(6.5); // ball\n");
  EXPECT_EQ(set("sphere(r = 5);", "sphere", 0, "", "x + 1"), "sphere(r = x + 1);");
  EXPECT_EQ(set("sphere(5);", "sphere", {}, "material", "\"red\""), "sphere(5, material = \"red\");");
  EXPECT_EQ(set("sphere( /* 5 */ );", "sphere", {}, "radius", "5"), "sphere(radius = 5 /* 5 */ );");
  EXPECT_EQ(set("union { cube(1); }", "union", {}, "radius", "2"), "union(radius = 2) { cube(1); }");
  EXPECT_EQ(set("box(\n  1,\n  2\n);", "box", {}, "z", "3"), "box(\n  1,\n  2,\n  z = 3\n);");
  EXPECT_EQ(set("size = 10; // [2:40]\n", "size", 0, "", "12"), "size = 12; // [2:40]\n");
  EXPECT_EQ(set("v = noise(size = 4);", "noise", 0, "", "5"), "v = noise(size = 5);");
  EXPECT_EQ(set("cube(2 * abs(-3));", "abs", 0, "", "4"), "cube(2 * abs(4));");
}

TEST(GraphEdit, RemovesArguments) {
  EXPECT_EQ(set("f(1, b = 2, c = 3);", "f", 1, "", ""), "f(1, c = 3);");
  EXPECT_EQ(set("f(1, b = 2, c = 3);", "f", 2, "", ""), "f(1, b = 2);");
  EXPECT_EQ(set("f(1, // one\n  b = 2, // two\n  c = 3);", "f", 1, "", ""), "f(1, // one\n   // two\n  c = 3);");
  EXPECT_EQ(set("f(5);", "f", 0, "", ""), "f();");
  EXPECT_EQ(set("f(1, 2);", "f", 0, "", ""),
            "the values behind this one have no names, and would take its place; edit line 1");
}

TEST(GraphEdit, RefusesWhatIsNoValue) {
  const std::string refused = "\" is no value; write for example 5, [1, 2, 3], \"red\" or size / 2";
  for (const std::string value : {"5); cube(3", "5 // five", "5;", "x = 2", "/* */ 5 /*", "for"})
    EXPECT_EQ(set("sphere(5);", "sphere", 0, "", value), '"' + value + refused) << value;
}

TEST(GraphEdit, RefusesWhatALoopMakes) {
  const std::string loop = "union() {\n  for (i = [0 : 3])\n    cube(i);\n}";
  EXPECT_EQ(set(loop, "cube", 0, "", "5"), "this is made by a loop; edit line 3");
  EXPECT_EQ(remove(loop, "cube", false), "this is made by a loop; edit line 3");
  EXPECT_EQ(set("module m() { cube(1); } m();", "cube", 0, "", "5"), "this is made by the module m; edit line 1");
  EXPECT_EQ(remove(loop, "for", false), "union() {\n}");
}

TEST(GraphEdit, InsertsAtTheEnd) {
  EXPECT_EQ(insert("", Where::end, "", "sphere(5)"), "sphere(5);\n");
  EXPECT_EQ(insert("cube(1);", Where::end, "", "sphere(5);"), "cube(1);\nsphere(5);\n");
  EXPECT_EQ(insert("cube(1); // end\n", Where::end, "", "sphere(5)"), "cube(1); // end\nsphere(5);\n");
  EXPECT_EQ(insert("", Where::end, "", "sphere(5) cube(1)"), "sphere(5) cube(1);\n");
  EXPECT_EQ(insert("", Where::end, "", "r = 5"), "\"r = 5\" is no call; write for example sphere(5)");
  EXPECT_EQ(insert("", Where::end, "", "a(); b()"), "\"a(); b()\" is no call; write for example sphere(5)");
}

TEST(GraphEdit, InsertsChildren) {
  const auto inside = [](const std::string& text) { return insert(text, Where::inside, "union", "sphere(5)"); };
  EXPECT_EQ(inside("union();"), "union() {\n  sphere(5);\n}");
  EXPECT_EQ(inside("union() ; // all\n"), "union()  {\n  sphere(5);\n} // all\n");
  EXPECT_EQ(inside("union() {}"), "union() {\n  sphere(5);\n}");
  EXPECT_EQ(inside("union() {\n}\n"), "union() {\n  sphere(5);\n}\n");
  EXPECT_EQ(inside("union() { cube(1); }"), "union() { cube(1); sphere(5); }");
  EXPECT_EQ(inside("union() { cube(1) }"), "union() { cube(1); sphere(5); }");
  EXPECT_EQ(inside("union() {\n    cube(1) // one\n  // two\n}\n"),
            "union() {\n    cube(1); // one\n  // two\n    sphere(5);\n}\n");
  EXPECT_EQ(inside("union() cube(1); // one\n"), "union() {\n  cube(1); // one\n  sphere(5);\n}\n");
  EXPECT_EQ(inside("f() {\n  union()\n    cube(1);\n}\n"),
            "f() {\n  union() {\n    cube(1);\n    sphere(5);\n  }\n}\n");
  EXPECT_EQ(inside("union() f() {\n  cube(1);\n}\n"), "union() {\n  f() {\n    cube(1);\n  }\n  sphere(5);\n}\n");
  EXPECT_EQ(insert("f() { union() }", Where::inside, "union", "sphere(5)"), "f() { union() {\n  sphere(5);\n} }");
}

TEST(GraphEdit, InsertsBesideAndAround) {
  EXPECT_EQ(insert("cube(1); // one\ncube(2);", Where::after, "cube", "sphere(5)"),
            "cube(1); // one\nsphere(5);\ncube(2);");
  EXPECT_EQ(insert("f() { cube(1); cone(2); }", Where::after, "cube", "sphere(5)"),
            "f() { cube(1); sphere(5); cone(2); }");
  EXPECT_EQ(insert("f() cube(1);", Where::after, "cube", "sphere(5)"), "f() {\n  cube(1);\n  sphere(5);\n}");
  EXPECT_EQ(insert("f() #cube(1);", Where::around, "cube", "translate([1, 0, 0])"),
            "f() #translate([1, 0, 0]) cube(1);");
  EXPECT_EQ(insert("for (i = [1 : 2]) cube(i);", Where::around, "for", "union()"),
            "union() for (i = [1 : 2]) cube(i);");
  EXPECT_EQ(insert("cube(1);", Where::around, "cube", "translate([1, 0, 0]) sphere(2)"),
            "\"translate([1, 0, 0]) sphere(2)\" has children already; write for example translate([1, 0, 0])");
}

TEST(GraphEdit, RemovesCallsWithTheirChildren) {
  EXPECT_EQ(remove("a();\n  cube(1); // one\nb();\n", "cube", false), "a();\nb();\n");
  EXPECT_EQ(remove("// two\ncube(1);\n// three\n", "cube", false), "// two\n// three\n");
  EXPECT_EQ(remove("a(); cube(1); b();", "cube", false), "a(); b();");
  EXPECT_EQ(remove("a() *cube(1);", "cube", false), "a();");
  EXPECT_EQ(remove("a() { cube(1); }", "cube", false), "a() { }");
  EXPECT_EQ(remove("f(size = noise(3), 2);", "noise", false), "f(2);");
  EXPECT_EQ(remove("f(2 * noise(3));", "noise", false), "this call is part of an expression; edit line 1");
}

TEST(GraphEdit, RemovesCallsAndKeepsTheirChildren) {
  EXPECT_EQ(remove("a() b() cube(1);", "b", true), "a() cube(1);");
  EXPECT_EQ(remove("a()\n  union() {\n    cube(1);\n  }\n", "a", true), "union() {\n  cube(1);\n}\n");
  EXPECT_EQ(remove("a() /* why */ cube(1);", "a", true), " /* why */ cube(1);");
  EXPECT_EQ(remove("x() {\n  union() { // all\n    cube(1);\n\n    // two\n    cube(2)\n  }\n}\n", "union", true),
            "x() {\n  // all\n    cube(1);\n\n    // two\n    cube(2);\n}\n");
  EXPECT_EQ(remove("x() {\n  union() {\n    cube(1);\n    // two\n    cube(2);\n  }\n}\n", "union", true),
            "x() {\n  cube(1);\n  // two\n  cube(2);\n}\n");
  EXPECT_EQ(remove("x() union() { cube(1); cube(2); }", "union", true), "x() { cube(1); cube(2); }");
  EXPECT_EQ(remove("union() { r = 2; cube(r); }", "union", true),
            "variables of these braces would become those of others; edit line 1");
}

TEST(GraphEdit, RemovesVariablesThatNobodyUses) {
  EXPECT_EQ(remove("r = 2; // [1:5]\ncube(3);", "r", false), "cube(3);");
  EXPECT_EQ(remove("r = 2;\ncube(\"r + x\");", "r", false), "\"r\" is used in line 2; give that another value first");
}

TEST(GraphEdit, Moves) {
  const std::string text = "a() {\n  cube(1); // one\n  sphere(2);\n}\nb();\n";
  EXPECT_EQ(move(text, "cube", "b"), "a() {\n  sphere(2);\n}\nb() {\n  cube(1); // one\n}\n");
  EXPECT_EQ(move(text, "cube", ""), "a() {\n  sphere(2);\n}\nb();\ncube(1); // one\n");
  EXPECT_EQ(move(text, "b", "a"), "a() {\n  cube(1); // one\n  sphere(2);\n  b();\n}\n");
  EXPECT_EQ(move("a() b() {\n  cube(1);\n}\nc() { d(); }\n", "b", "c"),
            "a();\nc() { d(); b() {\n    cube(1);\n  } }\n");
  EXPECT_EQ(move("a() b();", "a", "b"), "a call cannot be a child of itself; move it elsewhere");
  EXPECT_EQ(move("a() { r = 1; cube(r); } b();", "cube", "b"), "\"r\" means something else there; edit line 1");
}

TEST(GraphEdit, ConnectsVariables) {
  EXPECT_EQ(connect("c = cells([1, 1, 1]);\ncube(5);", "c", "distance", "cube", {}, "material"),
            "c = cells([1, 1, 1]);\ncube(5, material = c.distance);");
  EXPECT_EQ(connect("r = 4;\ncube(5);", "r", "", "cube", 0, ""), "r = 4;\ncube(r);");
  EXPECT_EQ(connect("a = noise(3);\nb = ramp(\"x\");\n", "b", "", "a", 0, ""), "b = ramp(\"x\");\na = noise(b);\n");
  EXPECT_EQ(connect("// A part.\n\n// a\na = noise(3);\nk = 2; // [1:3]\nb = ramp(k);\n", "b", "", "a", 0, ""),
            "// A part.\n\nk = 2; // [1:3]\nb = ramp(k);\n// a\na = noise(b);\n");
  EXPECT_EQ(connect("a = noise(3);\nb = ramp(a);\n", "b", "", "a", 0, ""), "\"a\" would depend on itself");
  EXPECT_EQ(connect("f() { r = 4; }\ncube(5);", "r", "", "cube", 0, ""),
            "\"r\" is not known in line 2; put it before the braces");
}

TEST(GraphEdit, MakesVariablesOfCallsInExpressions) {
  EXPECT_EQ(connect("// A ball.\n\n// Rough.\nball(2 * noise(3));\ncube(5);\n", "noise", "", "cube", 0, ""),
            "// A ball.\n\nnoise_values = noise(3);\n// Rough.\nball(2 * noise_values);\ncube(noise_values);\n");
  EXPECT_EQ(connect("cube(5);\nball(noise(3));\n", "noise", "", "cube", {}, "b"),
            "cube(5, b = noise_values);\nnoise_values = noise(3);\nball(noise_values);\n");
}

TEST(GraphEdit, AddsVariables) {
  const auto add = [](const std::string& text) { return after(text, AddVariable{"wall", "0.8"}); };
  EXPECT_EQ(add(""), "wall = 0.8;\n");
  EXPECT_EQ(add("// A part.\nuse <a.vcad>\nsize = 3; // mm\n\ncube(size);\n"),
            "// A part.\nuse <a.vcad>\nsize = 3; // mm\nwall = 0.8;\n\ncube(size);\n");
  EXPECT_EQ(add("// A part.\n\n// Its body.\ncube(2);\n"), "// A part.\n\nwall = 0.8;\n// Its body.\ncube(2);\n");
  EXPECT_EQ(add("cube(wall);"), "\"wall\" is used in line 1; choose another name");
}

TEST(GraphEdit, RenamesVariablesWhereTheyAreUsed) {
  const auto rename = [](const std::string& text, const std::string& name) {
    return after(text, RenameVariable{in(text, "r"), name});
  };
  EXPECT_EQ(rename("r = 2; // r\ncube(r = r, m = [\"0.5 + r*x\", \"rim\"]); function f(r) = r;", "rim_radius"),
            "rim_radius = 2; // r\ncube(r = rim_radius, m = [\"0.5 + rim_radius*x\", \"rim\"]); function f(r) = r;");
  EXPECT_EQ(rename("r = 2; cube(\"r\");", "q"), "the text \"r\" may mean this variable; edit line 1");
  EXPECT_EQ(rename("r = 2; q = 3;", "q"), "\"q\" is there already, in line 1; choose another name");
  EXPECT_EQ(rename("r = 2;", "for"), "\"for\" is no name; names have letters, digits and \"_\"");
}

TEST(GraphEdit, GroupsCalls) {
  const std::string text = "size = 4;\n// Two.\nunion() {\n  cube(size); // one\n  sphere(3, material = \"red\");\n}\n";
  GroupCalls group{{in(text, "cube"), in(text, "sphere")}, "pair", "A cube and a ball.", {}};
  group.parameters = {{in(text, "cube"), 0, "side"}, {in(text, "sphere"), 0, "radius"}};
  EXPECT_EQ(after(text, group),
            "size = 4;\n/// A cube and a ball.\nmodule pair(\n  side = size,\n  radius = 3\n) {\n"
            "  cube(side); // one\n  sphere(radius, material = \"red\");\n}\n// Two.\nunion() {\n  pair();\n}\n");
  group.parameters[1].name = "side";
  EXPECT_EQ(after(text, group), "two parameters have the name \"side\"; choose another name");
  const std::string apart = "a() { cube(1); sphere(2); cone(3); }";
  EXPECT_EQ(after(apart, GroupCalls{{in(apart, "cube"), in(apart, "cone")}, "pair", "", {}}),
            "the calls of a group follow each other within the same braces; move them together first");
}

TEST(GraphEdit, NamesLibraries) {
  const UseLibrary library{"ombre/cellular.vcad"};
  EXPECT_EQ(after("", library), "use <ombre/cellular.vcad>\n");
  EXPECT_EQ(after("// A part.\n// Mine.\nsize = 2;\n", library),
            "// A part.\n// Mine.\nuse <ombre/cellular.vcad>\nsize = 2;\n");
  EXPECT_EQ(after("use <a.vcad>\n// next\ncube(1);\n", library),
            "use <a.vcad>\nuse <ombre/cellular.vcad>\n// next\ncube(1);\n");
  EXPECT_EQ(after("use <ombre/cellular.vcad>\n", library), "use <ombre/cellular.vcad>\n");
}

TEST(GraphEdit, KeepsTheLineEndsOfTheText) {
  EXPECT_EQ(insert("union() {\r\n}\r\n", Where::inside, "union", "cube(1)"), "union() {\r\n  cube(1);\r\n}\r\n");
}

TEST(GraphEdit, RefusesScriptsWithMistakes) {
  EXPECT_EQ(after("sphere(", RemoveItem{0, false}), "expected a value, found the end of the file");
  EXPECT_EQ(after("sphere(1);", RemoveItem{7, false}), "the script has no call with the number 7");
  EXPECT_EQ(after("sphere(1);", MoveCall{0, 7}), "the script has no call with the number 7");
}

TEST(MoveToLibrary, TakesTheModuleItsCommentsAndTheLibraries) {
  const std::string script =
      "// A part.\n"
      "use <ombre/cellular.vcad>\n"
      "size = 3;\n"
      "\n"
      "// Discs of honeycomb.\n"
      "module disc(r = 5) {\n"
      "  cylinder(r, 2, honeycomb_walls());  // flat\n"
      "}\n"
      "disc(size);\n";
  Diagnostics diagnostics;
  const auto edited =
      edit(make_source("part.vcad", script), Dialect::vcad, MoveToLibrary{"disc", "disc.vcad", "A disc."}, diagnostics);
  ASSERT_TRUE(edited) << to_text(diagnostics);
  EXPECT_EQ(edited->text->text(), "// A part.\nuse <ombre/cellular.vcad>\nuse <disc.vcad>\nsize = 3;\n\ndisc(size);\n");
  EXPECT_EQ(edited->library,
            "use <ombre/cellular.vcad>\n/// A disc.\n// Discs of honeycomb.\nmodule disc(r = 5) {\n"
            "  cylinder(r, 2, honeycomb_walls());  // flat\n}\n");
}

TEST(MoveToLibrary, RefusesWhatNeedsTheScript) {
  const auto moved = [](const std::string& text) { return after(text, MoveToLibrary{"m", "m.vcad", ""}); };
  EXPECT_NE(moved("s = 2;\nmodule m() sphere(s);\nm();\n").find("\"m\" needs the variable \"s\" of the script"),
            std::string::npos);
  EXPECT_NE(moved("function f(x) = 2 * x;\nmodule m(s = 1) sphere(f(s));\nm();\n").find("needs \"f\""),
            std::string::npos);
  EXPECT_NE(moved("module n() cube(1);\nmodule m() n();\nm();\n").find("needs \"n\""), std::string::npos);
  EXPECT_NE(moved("sphere(1);\n").find("has no module \"m\""), std::string::npos);
  // A parameter hides a variable, and a module may call itself.
  EXPECT_EQ(moved("s = 2;\nmodule m(s = 1) if (s > 1) m(s - 1);\nm(s);\n"), "use <m.vcad>\ns = 2;\nm(s);\n");
}

}  // namespace
}  // namespace ombre::lang
