// Tests of OpenSCAD scripts. Expected results come from OpenSCAD 2021.01 or its documentation. tests/run_openscad.py
// compares whole scripts.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "draw/font_search.h"
#include "lang/openscad/colours.h"
#include "lang/openscad/csg_text.h"
#include "lang/openscad/customizer.h"
#include "lang/openscad/run_script.h"
#include "lang/openscad/value_text.h"
#include "solids/colour_bytes.h"

namespace ombre::lang::openscad {
namespace {

struct Said {
  std::string lines, tree;
};

Said run_text(const std::string& text, Options options = {}) {
  if (!options.read_file) options.read_file = [](const std::string&) { return std::nullopt; };
  Messages messages;
  const solids::TreePtr tree = run(make_source("t.scad", text), options, messages);
  return {messages.text(), tree ? csg_text(*tree, "") : "none"};
}

std::string value_of(const std::string& expression) { return run_text("echo(" + expression + ");").lines; }

// The text of a tree must be read back to the same tree: numbers, texts, semantics.
TEST(Openscad, ExactTreesAreReadAgainAsTheyWere) {
  const std::string script =
      "$fn = 7.5; difference(semantics = \"strict\") { rotate([0.1, 20, 1/3]) sphere(1/3);"
      "linear_extrude(2/3, twist = 40, slices = 3, segments = 5, v = [0, 1, -1]) text(\"a\\\"b\\\\\\t\");"
      "import(\"x.svg\", id = \"one\", dpi = 96); color(alpha = 0.5) resize([1, 0, 2], auto = [false, true]) "
      "cube(1e-7); }";
  const auto exact = [](const std::string& text) {
    Options options;
    options.read_file = [](const std::string&) { return std::nullopt; };
    Messages messages;
    const solids::TreePtr tree = run(make_source("t.scad", text), options, messages);
    return csg_text(*tree, "", CsgForm::exact);
  };
  const std::string once = exact(script);
  EXPECT_EQ(exact(once), once);
  for (const char* part :
       {"semantics = \"strict\"", "0.3333333333333333", "segments = 5", "a\\\"b\\\\\\t\"", "id = \"one\""})
    EXPECT_NE(once.find(part), std::string::npos) << part << " in\n" << once;
}

TEST(Openscad, AnOperationHasItsOwnSemantics) {
  Messages messages;
  const solids::TreePtr tree =
      run(make_source("t.scad", "union(semantics = \"permissive\") hull() cube(); hull(semantics = \"loose\");"), {},
          messages);
  EXPECT_EQ(tree->children[0]->semantics, solids::Semantics::permissive);
  EXPECT_EQ(tree->children[0]->children.at(0)->semantics, solids::Semantics::standard);
  EXPECT_EQ(messages.text(),
            "WARNING: semantics are \"default\", \"strict\" or \"permissive\", not \"loose\" in file t.scad, line 1\n");
}

TEST(Openscad, WordsOfOmbreNeedADesign) {
  EXPECT_EQ(run_text("use <ombre>\ncube();").lines,
            "ERROR: words of Ombre cannot be used here; give the script that says use <ombre> as the design itself\n");
  EXPECT_TRUE(uses_words(make_source("t.scad", "use <ombre>\ncube();"), {}));
  EXPECT_FALSE(uses_words(make_source("t.scad", "// use <ombre>\ncube();"), {}));
}

TEST(Openscad, PrintsSixDigits) {
  EXPECT_EQ(number_text(1.0 / 3), "0.333333");
  EXPECT_EQ(number_text(0.00001), "0.00001");
  EXPECT_EQ(number_text(0.000001), "1e-6");
  EXPECT_EQ(number_text(123456.5), "123457");  // a tie, rounded away from zero
  EXPECT_EQ(number_text(999999.5), "1e+6");
  EXPECT_EQ(number_text(-1e-7), "-1e-7");
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(stream_text(1e6), "1e+06");
}

TEST(Openscad, OperatorsWithoutMeaningGiveUndefAndAWarning) {
  EXPECT_EQ(value_of("1 + \"a\""),
            "WARNING: undefined operation (number + string) in file t.scad, line 1\nECHO: undef\n");
  EXPECT_EQ(value_of("[1, 2] * [[1, 2, 3], [4, 5, 6]]"), "ECHO: [9, 12, 15]\n");
  EXPECT_EQ(value_of("[6 | 1, 6 & 3, 1 << 4, 16 >> 2, ~0, 0xFF]"), "ECHO: [7, 2, 16, 4, -1, 255]\n");
}

TEST(Openscad, FunctionsWithoutMeaningGiveUndefAndAWarning) {
  const auto warned = [](const std::string& text) {
    return "WARNING: " + text + " in file t.scad, line 1\nECHO: undef\n";
  };
  EXPECT_EQ(value_of("pow(2)"), warned("pow() number of parameters does not match"));
  EXPECT_EQ(value_of("log(2, 3, 4)"), warned("log() number of parameters does not match"));
  EXPECT_EQ(value_of("max()"), warned("max() number of parameters does not match"));
  EXPECT_EQ(value_of("atan2(\"a\", 1)"), warned("atan2() parameter could not be converted"));
  EXPECT_EQ(value_of("len(true)"), warned("len() parameter could not be converted"));
  EXPECT_EQ(value_of("lookup(1, [[0 / 0, 2]])"), "ECHO: undef\n");  // there is no key
  EXPECT_EQ(value_of("[[1, 2], [3]] * [1, 2]"), warned("Matrix must be rectangular. Problem at row 1"));
  EXPECT_EQ(value_of("[[1, 2]] * [[1], [true]]"), warned("undefined operation (number * bool)"));
}

// Each result uses two numbers of std::mt19937.
TEST(Openscad, RandomNumbersAreThoseOfTheMersenneTwister) {
  EXPECT_EQ(value_of("rands(0, 1, 3, 42)"), "ECHO: [0.796543, 0.183435, 0.779691]\n");
}

// 2^31 - 1 is the prime of Python's rules for hashes of numbers; 0.5 is the inverse of 2 modulo this prime.
TEST(Openscad, SeedsOfRandomNumbersAreRemaindersOfAPrime) {
  EXPECT_EQ(value_of("rands(1, 2, 3, 0.5)"), value_of("rands(1, 2, 3, 1073741824)"));
  EXPECT_EQ(value_of("rands(1, 2, 3, 2147483649)"), value_of("rands(1, 2, 3, 2)"));
  EXPECT_EQ(value_of("rands(1, 2, 3, 0 / 0)"), value_of("rands(1, 2, 3, 0)"));
  EXPECT_EQ(value_of("rands(1, 2, 3, 4.1)"), "ECHO: [1.96977, 1.55343, 1.99383]\n");
  EXPECT_EQ(value_of("rands(1, 2, 3, -4.1)"), "ECHO: [1.19758, 1.92189, 1.67397]\n");
  EXPECT_EQ(value_of("rands(1, 2, 3, 1 / 0)"), "ECHO: [1.07767, 1.99766, 1.38584]\n");
  EXPECT_EQ(value_of("rands(1, 2, 1 / 0, 4)"),
            "WARNING: rands() cannot create an infinite number of results in file t.scad, line 1\n"
            "WARNING: resetting number of results to 1\nECHO: [1.90062]\n");
}

// The messages are those of OpenSCAD 2021.01, which judges a scale only beside an origin, and names one module for
// both.
TEST(Openscad, WrongOriginsAreNamed) {
  const auto warned = [](const std::string& text) { return "WARNING: " + text + " in file t.scad, line 1\n"; };
  EXPECT_EQ(run_text("rotate_extrude(origin = [1]) square();").lines,
            warned("rotate_extrude(..., origin=[1]) could not be converted"));
  EXPECT_EQ(run_text("linear_extrude(2, origin = [1, 2], scale = 3) square();").lines, "");
  EXPECT_EQ(run_text("linear_extrude(2, origin = [1, 2], scale = [3, 1 / 0]) square();").lines,
            warned("linear_extrude(..., scale=[3, inf]) could not be converted"));
  EXPECT_EQ(run_text("linear_extrude(2, origin = [1, 2, 3]) square();").lines,
            warned("linear_extrude(..., origin=[1, 2, 3]) could not be converted") +
                warned("linear_extrude(..., scale=undef) could not be converted"));
  EXPECT_EQ(run_text("import(\"none.off\", origin = \"x\");").lines,
            warned("linear_extrude(..., origin=\"x\") could not be converted"));
}

// OpenSCAD 2021.01 reports wrong points when it makes the geometry, and leaves the solid out.
TEST(Openscad, SolidsKeepWrongPointsAsTheyAreWritten) {
  const Said said = run_text("polygon([[0, 0], [1, 0], [\"a\", 1], 7]); polyhedron([[0, 0, 0], 5], [[0, 1, 1]]);");
  EXPECT_EQ(said.lines, "");
  EXPECT_NE(said.tree.find("polygon(points = [[0, 0], [1, 0], [\"a\", 1], 7], paths"), std::string::npos) << said.tree;
  EXPECT_NE(said.tree.find("polyhedron(points = [[0, 0, 0], 5], faces"), std::string::npos) << said.tree;
}

TEST(Openscad, ArgumentsAfterOneThatIsNoNumberAreNotEvaluated) {
  const auto unknown = [](const char* name) {
    return std::string("WARNING: Ignoring unknown variable '") + name + "' in file t.scad, line 1\n";
  };
  EXPECT_EQ(run_text("a = rands(v[0], w, x);").lines, unknown("v"));
  EXPECT_EQ(run_text("a = rands(1, \"a\", x);").lines, "");
  EXPECT_EQ(run_text("a = max(1, v, w);").lines,
            unknown("v") + "WARNING: max() parameter could not be converted in file t.scad, line 1\n");
  EXPECT_EQ(run_text("a = atan2(v, w);").lines,
            unknown("v") + unknown("w") + "WARNING: atan2() parameter could not be converted in file t.scad, line 1\n");
}

// The lines are those of OpenSCAD 2021.01. It forgets the first file, so that it may include itself once, and takes a
// path that begins in the working directory for another file than the same one beside the script.
TEST(Openscad, FilesThatIncludeThemselvesAreReadOncePerName) {
  const std::map<std::string, std::string> files{{"t.scad", "include <t.scad>\necho(\"t\");"},
                                                 {"a.scad", "include <sub/b.scad>\necho(\"a\");"},
                                                 {"sub/b.scad", "include <deep/../../a.scad>\necho(\"b\");"},
                                                 {"c.scad", "include <./c.scad>\necho(\"c\");"}};
  Options options;
  options.read_file = [&](const std::string& path) {
    const auto found = files.find(std::filesystem::path(path).lexically_normal().generic_string());
    return found == files.end() ? std::nullopt : std::optional(found->second);
  };
  const auto cannot = [](const char* path) {
    return std::string("WARNING: Can't open include file '") + path + "'.\n";
  };
  EXPECT_EQ(run_text(files.at("t.scad"), options).lines, cannot("t.scad") + "ECHO: \"t\"\nECHO: \"t\"\n");
  EXPECT_EQ(run_text("include <a.scad>", options).lines, cannot("deep/../../a.scad") + "ECHO: \"b\"\nECHO: \"a\"\n");
  EXPECT_EQ(run_text("include <c.scad>", options).lines, cannot("./c.scad") + "ECHO: \"c\"\nECHO: \"c\"\n");
}

TEST(Openscad, VariablesOfTheViewAreJudged) {
  EXPECT_EQ(run_text("$vpr = \"[1,2,3]\"; $vpt = [1, 2, 3, 4]; $vpd = [1];").lines,
            "WARNING: Unable to convert $vpr=\"[1,2,3]\" to a vec3 or vec2 of numbers\n"
            "WARNING: Unable to convert $vpt=[1, 2, 3, 4] to a vec3 or vec2 of numbers\n"
            "WARNING: Unable to convert $vpd=[1] to a number\n");
  EXPECT_EQ(run_text("$vpr = [1, 2]; $vpf = undef;").lines,
            "WARNING: Viewall and autocenter disabled in favor of $vp*\n");
}

TEST(Openscad, NumbersOfChildrenAreIntegersOf32Bits) {
  EXPECT_EQ(run_text("module m() children(1 / 0); m() cube();").lines,
            "WARNING: Negative children index (-2147483648) not allowed\n");
  EXPECT_EQ(run_text("child(-1); child(3);").lines,
            "DEPRECATED: child() will be removed in future releases. Use children() instead.\n"
            "WARNING: Negative child index (-1) not allowed in file t.scad, line 1\n");
}

TEST(Openscad, AMessageIsNotRepeatedMoreThanFiveTimes) {
  std::string five;
  for (int i = 0; i < 5; ++i) five += "WARNING: Ignoring unknown variable 'x' in file t.scad, line 1\n";
  EXPECT_EQ(run_text("for (i = [0:9]) if (x) cube();").lines, five);
}

// The results are those of OpenSCAD 2021.01.
TEST(Openscad, EmptyPlacesAreLeftOut) {
  EXPECT_EQ(value_of("[1,, 2,,,]"), "ECHO: [1, 2]\n");
  EXPECT_EQ(value_of("[,]"), "ECHO: []\n");
  EXPECT_EQ(run_text("echo(, 1,, 2);").lines, "ECHO: 1, 2\n");
  EXPECT_EQ(run_text("function f(, a,, b) = a + b; for (i = [1],, j = [2]) echo(f(i,, j));").lines, "ECHO: 3\n");
}

TEST(Openscad, RangesCompareByTheirElements) {
  EXPECT_EQ(value_of("[[1:1:0] == [5:1:4], [0:2:4] == [0:2:5], [0:2:4] < [0:2:5], [1:1:0] < [1:2], [1:2] < [1:1:0]]"),
            "WARNING: begin is greater than the end, but step is positive in file t.scad, line 1\n"
            "WARNING: begin is greater than the end, but step is positive in file t.scad, line 1\n"
            "WARNING: begin is greater than the end, but step is positive in file t.scad, line 1\n"
            "WARNING: begin is greater than the end, but step is positive in file t.scad, line 1\n"
            "ECHO: [true, true, false, true, false]\n");
}

TEST(Openscad, RangesWarnOfNumbersAsTheyAreWritten) {
  const std::string warning = "WARNING: begin is greater than the end, but step is positive in file t.scad, line 1\n";
  EXPECT_EQ(run_text("for (i = [5:1:-(1)]) echo(i);").lines, warning);
  EXPECT_EQ(run_text("for (i = [5:1:2 - 1]) echo(i);").lines, "");
  EXPECT_EQ(run_text("a = 5; for (i = [a:1:1]) echo(i);").lines, "");
}

TEST(Openscad, RangesMayBeInfinite) {
  EXPECT_EQ(run_text("for (i = [0:1/0:5]) echo(i); for (i = [0:-1/0:5]) echo(i); for (i = [1/0:1:5]) echo(i);").lines,
            "ECHO: 0\n");
}

TEST(Openscad, AnglesAreExactAtMultiplesOf30And45) {
  EXPECT_EQ(
      value_of("[sin(45) == sqrt(2) / 2, cos(405) == sqrt(2) / 2, sin(-60) == -sqrt(3) / 2, cos(150) == -sqrt(3) / 2, "
               "tan(30) == sqrt(3) / 3, tan(120) == -sqrt(3), tan(135) == -1]"),
      "ECHO: [true, true, true, true, true, true, true]\n");
}

TEST(Openscad, BracesHaveTheChildrenOfTheModuleAroundThem) {
  EXPECT_EQ(run_text("module outer() { inner() { echo(\"braces\", $children); cube(); } }"
                     "module inner() { echo(\"inner\", $children); children(); }"
                     "outer() { cube(); sphere(); cylinder(); }")
                .lines,
            "ECHO: \"inner\", 2\nECHO: \"braces\", 3\n");
  EXPECT_EQ(run_text("module n() children(); n() echo($children);").lines,
            "WARNING: Ignoring unknown variable '$children' in file t.scad, line 1\nECHO: undef\n");
}

TEST(Openscad, FilesMayHaveOtherEncodings) {
  EXPECT_EQ(run_text("a\xA0=\xC2\xA0"
                     "5; echo(a, \"\xE4\");")
                .lines,
            "ECHO: 5, \"\xE4\"\n");
}

TEST(Openscad, TailCallsTakeNoDepth) {
  EXPECT_EQ(run_text("function f(n) = n == 0 ? 7 : f(n - 1); echo(f(50000));").lines, "ECHO: 7\n");
}

TEST(Openscad, EndlessScriptsEndAtLimits) {
  Options options;
  options.limits.steps = 100'000;
  options.limits.calls = 1000;
  options.limits.depth = 500;
  EXPECT_NE(run_text("for (n = [0:99999]) { x = n; }", options).lines.find("steps"), std::string::npos);
  for (const std::string grows : {"f(str(x))", "f(concat(x, [1]))", "f(concat(x, x))", "f(str(x, x))"})
    EXPECT_EQ(run_text("function f(x) = " + grows + "; echo(f(\"a\"));", options).lines,
              "ERROR: Recursion detected calling function 'f' in file t.scad, line 1\n"
              "TRACE: called by 'f' in file t.scad, line 1\nTRACE: called by 'echo' in file t.scad, line 1\n")
        << grows;
  EXPECT_NE(run_text("module m() { m(); m(); } m();", options).lines.find("Recursion detected calling module 'm'"),
            std::string::npos);
  EXPECT_NE(run_text("module m(n) { if (n > 0) { m(n - 1); m(n - 1); } } m(20);", options).lines.find("calls modules"),
            std::string::npos);
  EXPECT_NE(run_text("function f(n) = 1 + f(n); echo(f(0));", options).lines.find("Recursion detected"),
            std::string::npos);
  EXPECT_NE(run_text("a = [for (i = [0:9999]) [for (j = [0:9999]) j]];", options).lines.find("ERROR"),
            std::string::npos);
}

TEST(Openscad, PartsAndMaterialsAreKeptAsWritten) {
  EXPECT_EQ(run_text("part(\"Lid 1\") material(\"PLA\") color(\"red\") cube();").tree,
            "part(name = \"Lid 1\") {\n\tmaterial(name = \"PLA\") {\n\t\tcolor([1, 0, 0, 1]) {\n"
            "\t\t\tcube(size = [1, 1, 1], center = false);\n\t\t}\n\t}\n}\n");
}

TEST(Openscad, SemanticsHoldBelow) {
  Messages messages;
  const auto tree =
      run(make_source("t.scad", "union() { $semantics = \"strict\"; union() cube(); } union() cube();"), {}, messages);
  ASSERT_TRUE(tree);
  ASSERT_EQ(tree->children.size(), 2U);
  EXPECT_EQ(tree->children[0]->children.at(0)->semantics, solids::Semantics::strict);
  EXPECT_EQ(tree->children[1]->semantics, solids::Semantics::standard);
}

TEST(Openscad, DefinitionsReplaceVariables) {
  Options options;
  options.definitions = {"a=5", "b=\"x\""};
  EXPECT_EQ(run_text("a = 1; c = a + 1; echo(a, b, c);", options).lines, "ECHO: 5, \"x\", 6\n");
}

TEST(Openscad, MistakesInTheTextHaveTheLineOfOpenscadAndMoreWords) {
  Messages messages;
  EXPECT_FALSE(run(make_source("t.scad", "x = 1\ny = 2;\n"), {}, messages));
  EXPECT_EQ(to_line(messages.list().front()), "ERROR: Parser error: syntax error in file t.scad, line 2");
  EXPECT_NE(to_text(messages.details).find("expected \";\""), std::string::npos);
}

// The texts are those of OpenSCAD's development snapshots.
TEST(Openscad, ObjectsHaveNamedMembers) {
  EXPECT_EQ(value_of("object(a = 1, b = [1, \"t\"])"), "ECHO: { a = 1; b = [1, \"t\"]; }\n");
  EXPECT_EQ(value_of("[object(), str(object(t = \"u\"))]"), "ECHO: [{ }, \"{ t = \"u\"; }\"]\n");
  EXPECT_EQ(value_of("object([[\"x\", 1], [\"y y\", 2]])"), "ECHO: { x = 1; y y = 2; }\n");
  EXPECT_EQ(run_text("o = object(a = 1, x = [4, 5], f = function(n) n + 1, o = object(z = 7));"
                     "echo(o.a, o[\"a\"], o.x.y, o.f(2), o.o.z, o.b, o[\"b\"], o[0]);")
                .lines,
            "ECHO: 1, 1, 5, 3, 7, undef, undef, undef\n");
  EXPECT_EQ(value_of("[for (k = object(a = 1, b = 2)) k]"), "ECHO: [\"a\", \"b\"]\n");
  EXPECT_EQ(run_text("for (k = object(a = 1, b = 2)) echo(k);").lines, "ECHO: \"a\"\nECHO: \"b\"\n");
  EXPECT_EQ(value_of("[is_object(object()), is_object([]), is_list(object()), is_undef(object())]"),
            "ECHO: [true, false, false, false]\n");
  EXPECT_EQ(value_of("[has_key(object(a = undef), \"a\"), has_key(object(a = 1), \"b\")]"), "ECHO: [true, false]\n");
}

TEST(Openscad, ObjectsAreMergedAndCompared) {
  EXPECT_EQ(value_of("object(object(a = 1, b = 2), c = 3)"), "ECHO: { a = 1; b = 2; c = 3; }\n");
  EXPECT_EQ(value_of("object(object(a = 1, b = 2), a = 4)"), "ECHO: { a = 4; b = 2; }\n");
  EXPECT_EQ(value_of("object(object(a = 1, b = 2, c = 3), [[\"b\"], [\"d\", 4]])"), "ECHO: { a = 1; c = 3; d = 4; }\n");
  EXPECT_EQ(value_of("object(object(a = 1, b = 2, c = 3), [[\"a\"]]).c"), "ECHO: 3\n");
  EXPECT_EQ(value_of("[object(a = [1]) == object(a = [1]), object(a = 1) != object(a = 1, b = 2), "
                     "object(a = 1) == object(b = 1), [object(a = 1)] == [object(a = 1)], object() == []]"),
            "ECHO: [true, true, false, true, false]\n");
  EXPECT_EQ(value_of("object() ? 1 : 2"), "ECHO: 2\n");
}

TEST(Openscad, ObjectsSayWhatIsWrong) {
  EXPECT_EQ(
      value_of("object(7)"),
      "WARNING: object() cannot take 7; write name = value, an object, or a list of entries [\"name\", value], or "
      "[\"name\"] to remove a member in file t.scad, line 1\nECHO: undef\n");
  EXPECT_NE(value_of("object([[]])").find("entry [] is no pair of a name and a value"), std::string::npos);
  EXPECT_NE(value_of("object([[\"a\", 1, 2]])").find("is no pair"), std::string::npos);
  EXPECT_EQ(value_of("object(a = 1) < object(a = 1)"),
            "WARNING: undefined operation (object < object) in file t.scad, line 1\nECHO: undef\n");
  EXPECT_NE(run_text("function f(n, o) = n == 0 ? o : f(n - 1, object(o = o)); echo(f(5000, 1));")
                .lines.find("Recursion detected calling function 'f'"),
            std::string::npos);
}

TEST(Openscad, ScriptsMayDefineNewerWords) {
  EXPECT_EQ(run_text("function object(x) = x + 1; echo(object(1));").lines, "ECHO: 2\n");
  EXPECT_EQ(run_text("function textmetrics(x) = 5; has_key = 3; echo(textmetrics(1), has_key);").lines, "ECHO: 5, 3\n");
  EXPECT_EQ(run_text("module roof() square(3); roof() square(1);").tree,
            "group() {\n\tsquare(size = [3, 3], center = false);\n}\n");
}

TEST(Openscad, RoofsHaveTwoMethods) {
  EXPECT_EQ(run_text("roof() square(1);").tree,
            "roof(method = \"voronoi\", convexity = 1, $fn = 0, $fa = 12, $fs = 2) {\n"
            "\tsquare(size = [1, 1], center = false);\n}\n");
  EXPECT_EQ(run_text("roof(\"straight\", convexity = 4, $fn = 9);").tree,
            "roof(method = \"straight\", convexity = 4, $fn = 9, $fa = 12, $fs = 2);\n");
  EXPECT_EQ(run_text("roof(method = \"flat\") square(1);").lines,
            "WARNING: Unknown roof method 'flat'. Using 'voronoi'. in file t.scad, line 1\n");
}

Said run_beside(const std::string& text, const std::string& json) {
  Options options;
  options.read_file = [&](const std::string& path) { return path == "data.json" ? std::optional(json) : std::nullopt; };
  return run_text(text, options);
}

TEST(Openscad, JsonFilesAreValues) {
  const std::string json =
      "{\"number\": 2, \"float\": 3.5e-10, \"bool\": true, \"string\": \"hallo world!\", \"none\": null, "
      "\"array-mixed\": [\"one\", 1, false], \"object\": {\"name\": \"n\", \"nested\": {\"value\": 42}}}";
  EXPECT_EQ(run_beside("j = import(\"data.json\"); echo(j.number, j.float, j.bool, j.string, j.none, "
                       "j[\"array-mixed\"], j.object.nested.value, j.object);",
                       json)
                .lines,
            "ECHO: 2, 3.5e-10, true, \"hallo world!\", undef, [\"one\", 1, false], 42, { name = \"n\"; nested = { "
            "value = 42; }; }\n");
  EXPECT_EQ(run_beside("echo(import(file = \"data.json\"));", "[1, 2]").lines, "ECHO: [1, 2]\n");
  EXPECT_EQ(run_beside("echo(import(\"other.json\"));", "1").lines,
            "WARNING: Can't open import file '\"other.json\"'. in file t.scad, line 1\nECHO: undef\n");
}

TEST(Openscad, WrongJsonStopsTheScript) {
  const std::string lines = run_beside("echo(import(\"data.json\"));", "{\n  \"a\": ]}").lines;
  EXPECT_TRUE(lines.starts_with("ERROR: data.json:2:8: ")) << lines;
  EXPECT_TRUE(run_beside("echo(import(\"data.stl\"));", "")
                  .lines.starts_with("ERROR: import(\"data.stl\") in an expression reads .json files alone"));
}

TEST(Openscad, JsonFilesAreDependencies) {
  Options options;
  options.read_file = [](const std::string&) { return std::optional<std::string>("[1]"); };
  Messages messages;
  const Outcome outcome =
      run_with_files(make_source("parts/t.scad", "a = import(\"d.json\"); b = import(\"d.json\"); import(\"e.stl\");"),
                     options, messages);
  EXPECT_EQ(outcome.files, (std::vector<std::string>{"parts/t.scad", "parts/d.json", "parts/e.stl"}));
}

// Letters are measured as they are drawn: text("Hog", 20) of OpenSCAD 2021.01 reaches from 2.726 to 52.1033 and from
// -5.7728 to 20.2496 if it is written to a file, and begins 54.2139 further left with the alignment "right".
TEST(Openscad, TextsAndFontsAreMeasured) {
  const auto font = draw::search_font("DejaVu Sans", false, false);
  if (!font || !font->has_name) GTEST_SKIP();
  EXPECT_EQ(
      value_of("fontmetrics(size = 20, font = \"DejaVu Sans\")"),
      "ECHO: { nominal = { ascent = 25.784; descent = -6.55111; }; max = { ascent = 34.2339; descent = -12.8581; }; "
      "interline = 32.3351; font = { family = \"DejaVu Sans\"; style = \"Book\"; }; }\n");
  EXPECT_EQ(value_of("textmetrics(\"Hog\", 20, \"DejaVu Sans\", halign = \"right\", valign = \"top\")"),
            "ECHO: { position = [-51.4879, -25.5478]; size = [49.3773, 26.0224]; ascent = 20.2496; descent = -5.7728; "
            "offset = [-54.2139, -19.775]; advance = [54.2139, 0]; }\n");
  EXPECT_EQ(value_of("textmetrics(\"\").size"), "ECHO: [0, 0]\n");
  EXPECT_EQ(value_of("textmetrics(\"a\", colour = 1) == textmetrics(\"a\")"),
            "WARNING: variable colour not specified as parameter in file t.scad, line 1\nECHO: true\n");
}

TEST(Openscad, CommentsDescribeParameters) {
  const auto parameters = parameters_of(make_source("t.scad", R"(
/* [Size] */
// How wide
width = 20; // [5:0.5:100]
offset = [1, -2]; // [0:10]
/* [Look] */
name = "box"; // [box, lid:Cover]
count = 3; // [1:one, 2:two]
label = "abc"; // 8
step = 1; // 0.25
on = true;
sum = 1 + 2;
/* [Hidden] */
fine = 4;
module m() { }
late = 1;
)"));
  ASSERT_EQ(parameters.size(), 8U);
  EXPECT_EQ(parameters[0].description, "How wide");
  EXPECT_EQ(parameters[0].section, "Size");
  EXPECT_EQ(parameters[0].least, 5);
  EXPECT_EQ(parameters[0].step, 0.5);
  EXPECT_EQ(parameters[0].most, 100);
  EXPECT_EQ(parameters[1].kind, Parameter::Kind::vector);
  EXPECT_EQ(parameters[1].most, 10);
  ASSERT_EQ(parameters[2].choices.size(), 2U);
  EXPECT_EQ(parameters[2].choices[1].second, "Cover");
  EXPECT_EQ(parameters[3].choices[0].first, Data(1.0));
  EXPECT_EQ(parameters[4].longest, 8U);
  EXPECT_EQ(parameters[5].step, 0.25);
  EXPECT_EQ(parameters[6].kind, Parameter::Kind::boolean);
  EXPECT_EQ(parameters[7].section, "Hidden");
}

TEST(Openscad, ParameterSetsAreDefinitions) {
  const auto parameters = parameters_of(make_source("t.scad", "width = 1;\nname = \"x\";\n"));
  const SourcePtr sets =
      make_source("sets.json", R"({"parameterSets": {"a": {"width": "7", "name": "5\"", "gone": "1"}}})");
  Diagnostics diagnostics;
  const auto definitions = parameter_set(sets, "a", parameters, diagnostics);
  ASSERT_TRUE(definitions);
  EXPECT_EQ(*definitions, (std::vector<std::string>{"width=7", "name=\"5\\\"\""}));
  EXPECT_NE(to_text(diagnostics).find("gone"), std::string::npos);
  EXPECT_FALSE(parameter_set(sets, "b", parameters, diagnostics));
  EXPECT_TRUE(diagnostics.has_errors());
}

TEST(OpenScadColours, HaveNamesOrDigits) {
  EXPECT_EQ(colour_name({255, 0, 0, 255}), "red");
  EXPECT_EQ(colour_name({0, 255, 0, 255}), "lime");
  EXPECT_EQ(colour_name({0, 255, 255, 255}), "cyan");
  EXPECT_EQ(colour_name({255, 0, 255, 255}), "magenta");
  EXPECT_EQ(colour_name({128, 128, 128, 255}), "gray");
  EXPECT_EQ(colour_name({0x12, 0x34, 0xab, 255}), "#1234ab");
  EXPECT_EQ(colour_name({255, 0, 0, 0x80}), "#ff000080");
  for (const char* name : {"rebeccapurple", "darkslategray", "tan", "#0a0b0c"}) {
    const auto colour = colour_of(name);
    ASSERT_TRUE(colour) << name;
    EXPECT_EQ(colour_name(solids::bytes_of(*colour)), name);
  }
}

}  // namespace
}  // namespace ombre::lang::openscad
