#include "lang/engine/interpret.h"

#include <gtest/gtest.h>

#include <map>

#include "base/text/error.h"
#include "base/text/test_cases.h"
#include "lang/engine/test_vocabulary.h"

namespace ombre::lang {
namespace {

using Cases = std::vector<std::pair<std::string, std::string>>;

void expect_nodes(const std::string& text, const std::string& expected, const Options& options = {}) {
  const Result result = run_script(text, options);
  EXPECT_EQ(result.nodes, expected) << text;
  EXPECT_EQ(result.messages, "") << text;
}

void expect_nodes(const char* cases) {
  for_cases(cases, [](const std::string& text, const std::string& expected) { expect_nodes(text, expected); });
}

// Compares the first line of the messages, without "part.vcad:".
void expect_message(const std::string& text, const std::string& expected) {
  const std::string message = first_message(text);
  EXPECT_EQ(message.substr(std::min<size_t>(message.size(), 10)), expected) << text;
}

TEST(Interpret, Nodes) {
  expect_nodes(R"(
    cube(5, "red"); => cube(5,"red")
    root((0, 0, 0), (1, 1, 1), (.1, .1, .1)) { sphere(1); } => root([0,0,0],[1,1,1],[0.1,0.1,0.1]){sphere(1)}
    function("x^2+y^2-4", "red"); => function("x^2+y^2-4","red")
    function f(x) = x; F-grade(["1"], [red, blue]) function(str("x-", f(2)));
      => fgrade(["1"],["red","blue"]){function("x-2")}
    Rotate(axis = x, deg = 45){ Cube(s = 5) } => rotate(axis="axis x",deg=45){cube(s=5)}
    x = 3; cube(x); => cube(3)
    show(undef, true, [0:2], [], -1e-9, ""); => show(undef,true,[0,1,2],[],-1e-09,"")
    union() { for (i = [0:1]) cube(i); if (true) { sphere(1); sphere(2); } }
      => union(){cube(0) cube(1) sphere(1) sphere(2)}
    translate(1) translate(2) cube(3); => translate(1){translate(2){cube(3)}}
    union() { };;; cube(1); => union() cube(1)
  )");
}

TEST(Interpret, ControlFlow) {
  expect_nodes(R"(
    for (i = [0:1], j = "ab") show(i, j); => show(0,"a") show(0,"b") show(1,"a") show(1,"b")
    for (v = [[1, 2], [3, 4]]) show(v.y); => show(2) show(4)
    for (i = []) cube(i); for (i = [0:-1]) cube(i); =>
    if (1 > 2) cube(1); else if ("") cube(2); else cube(3); => cube(3)
    let (a = 1, b = a + 1) show(a, b); => show(1,2)
    assert(true) cube(1); echo(1) cube(2); => cube(1) cube(2)
    *cube(1); %cube(2); #cube(3); => cube(3)
    cube(1); union() { !cube(2); cube(3); } => cube(2)
  )");
}

TEST(Interpret, AssignmentsAreHoistedAndTheLastOneWins) {
  for_cases(R"(
    cube(a); a = 1; => cube(1)
    a = 1; b = a; a = 2; show(a, b); => show(2,2)
    a = 1; union() { show(a); a = 2; } show(a); => union(){show(2)} show(1)
    a = 1; { a = 3; } show(a); => show(3)
    a = 1; module m() { b = a; a = 5; show(a, b); } m(); => show(5,1)
    function f() = a; a = 4; show(f()); => show(4)
    if (true) { a = 1; show(a); } a = 2; show(a); => show(1) show(2)
    module m() cube(1); module m() cube(2); m(); => cube(2)
  )",
            [](const std::string& text, const std::string& expected) {
              EXPECT_EQ(run_script(text).nodes, expected) << text;
            });
}

TEST(Interpret, ModulesAndChildren) {
  expect_nodes(R"(
    module m(a, b = 2, c) show(a, b, c); m(1); m(1, c = 3); m(b = 5, 1);
      => show(1,2,undef) show(1,2,3) show(1,5,undef)
    module m(a, b = a * 2) show(b); m(4); => show(8)
    module m() { children(); } m() { cube(1); cube(2); } => cube(1) cube(2)
    module m() { children(1); } m() { cube(1); cube(2); } => cube(2)
    module m() { children([2, 0]); } m() { cube(1); cube(2); cube(3); } => cube(3) cube(1)
    module m() { children([1:2]); } m() { cube(1); cube(2); cube(3); } => cube(2) cube(3)
    module m() show($children); m() { cube(1); a = 2; *cube(2); if (true) cube(3); } m(); => show(2) show(0)
    module m() { for (i = [0:$children - 1]) translate(i) children(i); } m() { cube(1); for (j = [1:2]) cube(j); }
      => translate(0){cube(1)} translate(1){cube(1) cube(2)}
    module in() { union() children(); } module out() { in() { children(); cube(9); } } out() cube(1);
      => union(){cube(1) cube(9)}
    module m() { a = 1; children(); } a = 2; m() cube(a); => cube(2)
    module m() { children(); } m() { cube(a); a = 7; } => cube(7)
    module m(n) { if (n > 0) { cube(n); m(n - 1); } } m(3); => cube(3) cube(2) cube(1)
    module outer() { module inner() cube(b); b = 3; inner(); } outer(); => cube(3)
    module Cube() sphere(1); Cube(); cube(2); => sphere(1) cube(2)
  )");
}

TEST(Interpret, SpecialVariablesFollowTheCalls) {
  expect_nodes(R"(
    module m() show($a); $a = 1; m(); m($a = 2); m(); => show(1) show(2) show(1)
    module out() { $a = 5; children(); } $a = 1; out() show($a); show($a); => show(5) show(1)
    function f() = $a; show(let($a = 3) f()); => show(3)
    function f($a = 4) = g(); function g() = $a; show(f(), f($a = 6)); => show(4,6)
    function f() = $a; for ($a = [1, 2]) show(f()); => show(1) show(2)
    show($fn, $fa, $fs, $t, $preview); => show(0,12,2,0,false)
    union($a = 3) show($a); => union(){show(3)}
  )");
}

TEST(Interpret, Recursion) {
  expect_nodes(R"(
    function sum(n, s = 0) = n == 0 ? s : sum(n - 1, s + n); show(sum(100000)); => show(5000050000)
    function f(n) = n == 0 ? 0 : let(m = n - 1) assert(m >= 0) f(m); show(f(100000)); => show(0)
    even = function(n) n == 0 ? true : odd(n - 1); odd = function(n) n == 0 ? false : even(n - 1); show(even(100001));
      => show(false)
    function sum(v, i = 0) = i < len(v) ? v[i] + sum(v, i + 1) : 0; show(sum([for (i = [1:1000]) i])); => show(500500)
  )");
}

// Returns options for scripts that find these files, by path and text.
Options with_files(const std::map<std::string, std::string>& files) {
  Options options;
  options.read_file = [files](const std::string& path) -> std::optional<std::string> {
    const auto found = files.find(path);
    return found == files.end() ? std::nullopt : std::optional(found->second);
  };
  return options;
}

TEST(Interpret, IncludeAndUse) {
  const Options options =
      with_files({{"lib/a.vcad", "include <b.vcad> w = 2; module m() show(w, b); function f(x) = x + w; cube(1);"},
                  {"lib/b.vcad", "b = 7;"},
                  {"top.vcad", "module top() cube(9);"}});
  EXPECT_EQ(run_script("include <lib/a.vcad> w = 5; m(); show(f(1));", options).nodes, "cube(1) show(5,7) show(6)");
  EXPECT_EQ(run_script("use <lib/a.vcad>\n w = 5; m(); show(f(1));", options).nodes, "show(2,7) show(3)");
  EXPECT_EQ(run_script("use <lib/a.vcad> use <top.vcad> top();", options).nodes, "cube(9)");
  EXPECT_EQ(first_message("use <lib/a.vcad>\nshow(b);", options).substr(0, 45),
            "part.vcad:2:6: error: there is no variable \"b");
  EXPECT_EQ(first_message("include <no.vcad>", options),
            "part.vcad:1:10: error: there is no file \"no.vcad\"; looked for no.vcad");
}

TEST(Interpret, CyclesOfIncludesAreReported) {
  Options options;
  options.read_file = [](const std::string& path) -> std::optional<std::string> {
    if (path == "a") return "include <b>";
    if (path == "b") return "include <a>";
    if (path.front() == 'n') return "include <n" + path + ">";
    if (path == "twice") return "include <half> include <half>";
    if (path == "half") return "v = 1;";
    return std::nullopt;
  };
  EXPECT_EQ(first_message("include <a>", options),
            "b:1:10: error: \"a\" includes itself, through b; move what both need into a third file");
  EXPECT_NE(first_message("include <n>", options).find("files include each other deeper than 32 levels"),
            std::string::npos);
  EXPECT_EQ(run_script("include <twice> show(v);", options).nodes, "show(1)");
}

TEST(Interpret, FilesMayUseEachOther) {
  const Options options =
      with_files({{"a", "use <b> use <a> k = 3; module plate() { show(k, twice(k)); } module both() { stack(); }"},
                  {"b", "use <a> include <c> function twice(v) = 2 * v; module stack() { plate(); }"},
                  {"c", "use <b> module other() { stack(); }"}});
  EXPECT_EQ(run_script("use <a> both();", options).nodes, "show(3,6)");
  EXPECT_EQ(run_script("use <b> other();", options).nodes, "show(3,6)");
  EXPECT_EQ(run_script("include <b> other();", options).nodes, "show(3,6)");
}

TEST(Interpret, DefinitionsTakeThePlaceOfVariables) {
  Options options;
  options.definitions = {{"a", Data(5.0)}, {"v", Data(DataList{Data(1.0), Data("s")})}, {"$fn", Data(9.0)}};
  EXPECT_EQ(run_script("a = 1; b = a * 2; show(a, b, v, $fn);", options).nodes, "show(5,10,[1,\"s\"],9)");
}

TEST(Interpret, InvocationsKnowTheirPlaces) {
  const std::string text =
      "m = \"red\"; n = [1, \"blue\"];\nmodule k() { cube(1, m); }\nunion(a = \"g\") k();\nshow(n, \"t\\n\");";
  const Result result = run_script(text);
  ASSERT_EQ(result.calls.size(), 3u);
  const auto at = [&](const SourceRange& range) { return text.substr(range.begin, range.end - range.begin); };
  const Invocation &cube = result.calls[0], &group = result.calls[1], &show = result.calls[2];
  EXPECT_EQ(at(cube.arguments[1].value.where), "red");
  EXPECT_EQ(at(cube.arguments[0].value.where), "1");
  EXPECT_EQ(at(cube.where), "cube");
  EXPECT_EQ(at(cube.whole), "cube(1, m)");
  EXPECT_FALSE(cube.is_top_level);
  ASSERT_EQ(cube.called_from.size(), 1u);
  EXPECT_EQ(at(cube.called_from[0]), "k()");
  EXPECT_TRUE(group.is_top_level);
  EXPECT_EQ(at(group.arguments[0].name_where), "a");
  EXPECT_EQ(at(group.arguments[0].value.where), "g");
  EXPECT_EQ(at(show.arguments[0].value.where), "n");
  EXPECT_EQ(at((*show.arguments[0].value.list())[1].where), "blue");
  EXPECT_EQ(at((*show.arguments[0].value.list())[0].where), "1");
  EXPECT_EQ(at(show.arguments[1].value.where), "\"t\\n\"");
}

TEST(Interpret, MistakesArePointedAt) {
  for_cases(R"(
    nosuch(); => 1:1: error: there is no node or module "nosuch"; define it first: module nosuch(...) { ... }
    sphre(1); => 1:1: error: there is no node or module "sphre"; did you mean "sphere"?
    color(1); => 1:1: error: there is no node or module "color"; write material
    module gear() cube(1); gaer(); => 1:24: error: there is no node or module "gaer"; did you mean "gear"?
    width = 1; cube(widht); => 1:17: error: there is no variable "widht"; did you mean "width"?
    a = b; b = 1; => 1:5: error: "b" has no value yet; its assignment comes later in this scope; move it up
    function f(x) = x; cube(f); => 1:25: error: "f" is a function, not a value; call it: f(...)
    f = 3; cube(f(1)); => 1:13: error: "f" is a number, not a function
    module m(size) cube(1); m(sizes = 1); => 1:27: error: "m" has no parameter "sizes"; did you mean "size"?
    module m(a, b) cube(1); m(1, 2, 3); => 1:33: error: too many arguments for "m"; it takes a, b
    function f() = 1; cube(f(1)); => 1:26: error: too many arguments for "f"; it takes none
    module m(a) cube(1); m(1, a = 2); => 1:27: error: the parameter "a" is given twice
    module m(a, a) cube(1); => 1:13: error: the parameter "a" is there already
    cube(function(x) x); => 1:6: error: a function cannot be a parameter of a node; call it, and give its result
    for (i = 3) cube(i);
      => 1:10: error: "for" needs a range, a list or a string, found a number; a range is written [first : last] or [first : step : last]
    children(); => 1:1: error: children() means something inside of a module only
    module m() children(2); m() cube(1);
      => 1:21: warning: there is no child 2; this call of the module has 1 child, counted from 0
    assert(1 == 2, "sizes differ"); => 1:8: error: the assertion does not hold: sizes differ
    cube(1 + "a"); => 1:8: error: cannot compute a number + a string; write str(a, b) to join texts
  )",
            expect_message);
}

TEST(Interpret, OneRunFindsSeveralMistakes) {
  const Result result = run_script(
      "a = nosuch1;\nshow(a);\nb = 1 + undef;\nunion() { show(nosuch2); cube(1); }\nfor (i = [0:99]) { show(i + \"\"); "
      "}\n"
      "for (i = [0:9]) broken();\ncube(2);");
  EXPECT_EQ(result.nodes, "union(){cube(1)} cube(2)");
  EXPECT_EQ(result.messages,
            "part.vcad:1:5: error: there is no variable \"nosuch1\"; give it a value first: nosuch1 = ...;\n"
            "  1 | a = nosuch1;\n    |     ^~~~~~~\n"
            "part.vcad:3:7: error: cannot compute a number + undef\n"
            "  3 | b = 1 + undef;\n    |       ^\n"
            "part.vcad:4:16: error: there is no variable \"nosuch2\"; give it a value first: nosuch2 = ...;\n"
            "  4 | union() { show(nosuch2); cube(1); }\n    |                ^~~~~~~\n"
            "part.vcad:5:27: error: cannot compute a number + a string; write str(a, b) to join texts\n"
            "  5 | for (i = [0:99]) { show(i + \"\"); }\n    |                           ^\n"
            "part.vcad:6:17: error: broken is broken\n"
            "  6 | for (i = [0:9]) broken();\n    |                 ^~~~~~\n");
}

TEST(Interpret, AFailedAssertionEndsItsModule) {
  const Result result = run_script("module m(n) { assert(n > 0); cube(n); } m(0); m(1);");
  EXPECT_EQ(result.nodes, "cube(1)");
}

TEST(Interpret, LimitsAreDiagnostics) {
  for_cases(R"(
    for (i = [0:1e9]) cube(i);
      => 1:10: error: this range has 1,000,000,001 elements, more than 10,000,000; choose a larger step or a nearer end
    cube([0:1e300]);
      => 1:6: error: this range has 1e+300 elements, more than 10,000,000; choose a larger step or a nearer end
    v = [for (i = 0; true; i = i + 1) if (i < 0) i];
      => 1:18: error: this loop has 10,000,001 elements, more than 10,000,000; choose a larger step or a nearer end
    v = [for (i = 0, l = [1]; i < 40; i = i + 1, l = concat(l, l)) 0];
      => 1:50: error: the lists of this design hold more than 10,000,000 elements; build fewer or shorter lists
    v = [for (i = 0, l = [1]; i < 40; i = i + 1, l = [l, l]) 0];
      => 1:50: error: the lists of this design hold more than 10,000,000 elements; build fewer or shorter lists
    v = [for (i = 0, l = [1]; i < 400; i = i + 1, l = [l]) 0];
      => 1:51: error: lists nest deeper than 200 levels; join lists with concat or each instead of putting them into each other
    v = [for (i = 0, s = "a"; i < 40; i = i + 1, s = str(s, s)) 0];
      => 1:50: error: the strings and values of this design hold more than 100,000,000 bytes; build fewer or shorter ones
    r = rands(0, 1, 1e12);
      => 1:5: error: the lists of this design hold more than 10,000,000 elements; build fewer or shorter lists
  )",
            expect_message);
}

TEST(Interpret, EndlessRecursionIsADiagnostic) {
  for (const char* text :
       {"function r(n) = 1 + r(n + 1); cube(r(0));", "module e() { e(); } e();",
        "module e() { for (i = [0], j = [0]) if (true) { a = 1; translate() e(); } } e();",
        "function r(n) = [each [for (i = [0]) let (a = 1) r(n + 1)]]; cube(r(0));",
        "function r(n) = max(1, -(2 ^ r(n + 1)[0])); cube(r(0));", "function r(n, k = r(1)) = 1; cube(r(0));",
        "function r(n) = [for (i = 0; i < 1; i = i + 1) each r(n)]; cube(r(0));", "module e() { %e() { e(); } } e();",
        "module m() { children(); m() children(); } m() m();", "f = function(g) [g(g)]; cube(f(f));"}) {
    const std::string messages = run_script(text).messages;
    EXPECT_NE(messages.find("are evaluated inside each other deeper than 5,000 levels"), std::string::npos)
        << text << messages;
  }
}

void expect_limits(const Options& options, const Cases& cases) {
  for (const auto& [text, message] : cases) {
    const std::string found = first_message(text, options);
    EXPECT_NE(found.find(message), std::string::npos) << text << found;
    EXPECT_EQ(found.substr(0, 10), "part.vcad:") << found;
  }
}

TEST(Interpret, StepsAndInstancesAreLimited) {
  Options options;
  options.limits.steps = 100'000;
  EXPECT_NE(first_message("function f(n) = f(n + 1); cube(f(0));", options).find("takes more than 100,000 steps"),
            std::string::npos);
  EXPECT_NE(first_message("module m() { m2(); m2(); } module m2() { for (i = [0:1e6], j = [0:1e6]) { } } m();", options)
                .find("takes more than 100,000 steps"),
            std::string::npos);
  options.limits.instances = 100;
  const Result result = run_script("for (i = [0:999]) cube(i);", options);
  EXPECT_EQ(result.calls.size(), 100u);
  EXPECT_NE(result.messages.find("the design makes more than 100 nodes"), std::string::npos);
}

// Recursion that doubles at each level must stop. With the default limits it stops after millions of calls or nodes,
// which takes seconds, instead of 10^9.
TEST(Interpret, WhatDoublesAtEachLevelIsLimited) {
  Options options;
  options.limits.calls = 5000;
  const std::string calls =
      "error: the design calls modules more than 5,000 times; look for a module that calls itself";
  expect_limits(options, {{"module a(n) { if (n > 0) { a(n - 1); a(n - 1); } else cube(1); }\na(40);", calls},
                          {"module a(n) { if (n > 0) { a(n - 1); a(n - 1); } }\na(40);", calls},
                          {"module a(n) { if (n > 0) { b(n - 1); b(n - 1); } }\nmodule b(n) a(n);\na(40);", calls},
                          {"module d(n) { if (n > 0) d(n - 1) { children(); children(); } else children(); }\n"
                           "d(40) cube(1);",
                           calls}});
  options.limits = {};
  options.limits.instances = 5000;
  expect_limits(options, {{"for (i = [0:999]) for (j = [0:999]) cube(1);", "error: the design makes more than 5,000"}});
}

// Returns options with and without reading ahead.
std::vector<Options> for_long_lists() {
  Options one, several;
  several.threads = 2;
  return {one, several};
}

// Returns enough calls that they are deferred.
std::string numbered_cubes(int count) {
  std::string text;
  for (int n = 0; n < count; ++n) text += "cube(" + std::to_string(n) + ");\n";
  return text;
}

TEST(Interpret, LongListsMeanWhatShortOnesDo) {
  std::string expected;
  for (int n = 0; n < 3000; ++n) expected += (n > 0 ? " cube(" : "cube(") + std::to_string(n) + ")";
  const std::string many = numbered_cubes(3000), row = "union() {" + many + "}", rows = row + row + many + row;
  const std::string made = "union(){" + expected + "}";
  const Cases cases = {
      {many, expected},
      {row, made},
      {"{" + many + "}", expected},
      {"module m() {" + many + "} m();", expected},
      {"for (i = [0:0]) {" + many + "}", expected},
      {"module m() children(); m() {" + many + "}", expected},
      {"module m() children(2500); m() {" + many + "}", "cube(2500)"},
      {"module m() { children(2500); children(2100); } m() {" + many + row + "}", "cube(2500) cube(2100)"},
      {"module m() cube($children); m() {" + many + "}", "cube(3000)"},
      {rows, made + " " + made + " " + expected + " " + made}};
  for (const Options& options : for_long_lists())
    for (const auto& [text, nodes] : cases) expect_nodes(text, nodes, options);
}

TEST(Interpret, ManyLongListsWithinALongOneAreRead) {
  std::string text, expected;
  for (int n = 0; n < 40; ++n) text += numbered_cubes(60);
  text += "union() {" + text + "union() {" + text + "} }" + text;
  const std::string one = run_script(text).nodes;
  Options several;
  several.threads = 2;
  EXPECT_EQ(run_script(text, several).nodes, one);
  EXPECT_GT(one.size(), 4 * 2400 * std::string("cube(1)").size());
}

TEST(Interpret, LongListsMayHoldAnything) {
  const std::string before = "module nothing() {}\n" + std::string(2000, ';');
  std::string many;
  for (int n = 0; n < 2000; ++n) many += "nothing();";
  const Cases cases = {
      {before + many + "*cube(1); %cube(2); #cube(3);", "cube(3)"},
      {many + "cube(1); module nothing() {} !cube(2); !union() { cube(3); }", "cube(2) union(){cube(3)}"},
      {before + many + "F-grade([\"1\"], [red]) { a = 3; cube(a); } cube(a); a = 4;",
       "fgrade([\"1\"],[\"red\"]){cube(3)} cube(4)"},
      {before + many + "module give(f) cube(f(2)); give(function(n) n + 1);", "cube(3)"},
      {before + many + "union() {" + many + "cube(1); union() { cube(2); } }", "union(){cube(1) union(){cube(2)}}"}};
  for (const Options& options : for_long_lists())
    for (const auto& [text, nodes] : cases) expect_nodes(text, nodes, options);
}

TEST(Interpret, MistakesInLongListsAreTheSameReadAhead) {
  Options several;
  several.threads = 2;
  for (const std::string mistake : {"cube(nowhere);", "broken();", "assert(false);", "show(\"\\q\");", "cube(1;"}) {
    const std::string text = numbered_cubes(2500) + mistake + numbered_cubes(2500);
    const Result one = run_script(text), ahead = run_script(text, several);
    EXPECT_EQ(ahead.messages, one.messages);
    EXPECT_NE(ahead.messages, "");
    EXPECT_EQ(ahead.nodes, one.nodes);
  }
}

TEST(Interpret, MistakesInLongListsAreReportedOnceWithTheirPlaces) {
  const std::string many = numbered_cubes(2000);
  expect_message(many + "cube(1;", "2001:7: error: expected \",\" or \")\" after this argument, found \";\"");
  expect_message(many + "cube(nowhere);",
                 "2001:6: error: there is no variable \"nowhere\"; give it a value first: nowhere = ...;");
  const std::string messages = run_script(many + "show(\"\\q\"); union() { a = 1; a = 2; }").messages;
  for (const std::string_view message : {"starts no escape", "has a value already"}) {
    EXPECT_NE(messages.find(message), std::string::npos) << messages;
    EXPECT_EQ(messages.find(message), messages.rfind(message)) << messages;
  }
}

TEST(Interpret, LimitsInLongListsNameThePlace) {
  Options options;
  options.limits.instances = 2500;
  EXPECT_EQ(first_message(numbered_cubes(3000), options).substr(0, 40), "part.vcad:2501:1: error: the design make");
}

TEST(Interpret, ClosuresInRingsAndRowsAreFreed) {
  Options options;
  EXPECT_EQ(
      run_script("v = [for (i = 0, f = function() 0; i < 300000; i = i + 1, f = function() f) 0]; show(len(v));").nodes,
      "show(3e+05)");
  EXPECT_EQ(run_script("for (i = [0:200000]) { f = function(n) f(n); }").messages, "");
  options.limits.closures = 1000;
  EXPECT_NE(
      first_message("v = [for (i = [0:100000]) function() i];", options).find("keep more than 1,000 scopes alive"),
      std::string::npos);
}

TEST(Interpret, StopsOnRequest) {
  StopFlag stop;
  stop.request();
  Options options;
  options.stop = &stop;
  EXPECT_THROW(run_script("cube(1);", options), Cancelled);
  options.threads = 2;
  EXPECT_THROW(run_script(numbered_cubes(5000), options), Cancelled);
}

TEST(Interpret, NothingIsEvaluatedAfterASyntaxError) {
  const Result result = run_script("a = ; cube(a); cube(1);");
  EXPECT_EQ(result.nodes, "");
  EXPECT_EQ(result.messages,
            "part.vcad:1:5: error: expected a value, found \";\"\n  1 | a = ; cube(a); cube(1);\n    |     ^\n");
}

const std::string honey_module = R"(/// Hexagonal cells.
module honey(
  size = 6,     // [1:0.5:20] mm: Width of a cell
  core = "soft",// material: What fills the cells
  lie = "flat", // [flat, steep] text: How they lie
  at = [0, 0],  // vector mm: Where
  count = 3     // [1:9] number: How many
) { show(size, core, lie, at, count); }
/// A length.
function width(
  of            // number mm: Of what
) = 2 * of;
)";

TEST(Interpret, DeclaredParametersAreChecked) {
  const Cases cases{
      {"honey(25);", "13:7: error: honey: size: expected a number from 1 to 20 (mm), found 25"},
      {"honey(\"big\");", "13:7: error: honey: size: expected a number from 1 to 20 (mm), found \"big\""},
      {"honey(core = 3);", "13:14: error: honey: core: expected a material or a mixture, found 3"},
      {"honey(lie = \"falt\");", "13:13: error: honey: lie: expected one of \"flat\", \"steep\", found \"falt\""},
      {"honey(at = 3);", "13:12: error: honey: at: expected a list of numbers (mm), found 3"},
      {"honey(at = [1, true]);", "13:12: error: honey: at: expected a list of numbers (mm), found a list of 2"},
      {"honey(count = 0);", "13:15: error: honey: count: expected a number from 1 to 9, found 0"},
      {"cube(width(true));", "13:12: error: width: of: expected a number (mm), found true"}};
  for (const auto& [call, message] : cases) expect_message(honey_module + call, message);
  expect_nodes(honey_module + "honey(20, at = [1, 2]); cube(width(3)); honey(undef);",
               "show(20,\"soft\",\"flat\",[1,2],3) cube(6) show(undef,\"soft\",\"flat\",[0,0],3)");
}

// Places, directions and lists of points are checked to their last number, and what is no number is none.
TEST(Interpret, DeclaredPlacesAreChecked) {
  const std::string axes = R"(/// Lines from points.
module axes(
  from = [0, 0, 0], // point mm: Where they begin
  along = [1, 0, 0],// direction: Where they go
  over = [],        // points mm: What they pass
  length = 1,       // number mm: How far
  thick = 1,        // radius mm: How thick
  size = 1,         // length mm: How large
  of = "red"        // material: Of what
) { show(from, along, over, length); }
)";
  const Cases cases{
      {"axes([1, 2]);", "11:6: error: axes: from: expected three numbers (mm), found [1, 2]"},
      {"axes(2);", "11:6: error: axes: from: expected three numbers (mm), found 2"},
      {"axes(along = [0, 0, 0]);",
       "11:14: error: axes: along: expected three numbers that are not all 0, found [0, 0, 0]"},
      {"axes(over = [1, 2]);", "11:13: error: axes: over: expected a list of points (mm), found [1, 2]"},
      {"axes(over = [[1, 2, 3], [1, \"a\", 3]]);",
       "11:13: error: axes: over: expected a list of points (mm), found a list of 2"},
      {"axes(length = 0/0);", "11:15: error: axes: length: expected a number (mm), found nan"},
      {"axes([0, 0, 0/0]);", "11:6: error: axes: from: expected three numbers (mm), found [0, 0, nan]"},
      {"axes([0, 0, 1/0]);", "11:6: error: axes: from: expected three numbers (mm), found [0, 0, inf]"},
      {"axes(length = -1/0);", "11:15: error: axes: length: expected a number (mm), found -inf"},
      {"axes(thick = -1);", "11:14: error: axes: thick: expected a number of 0 or more (mm), found -1"},
      {"axes(size = 0);", "11:13: error: axes: size: expected a number above 0 (mm), found 0"},
      {"axes(of = \"redd\");", "11:11: error: axes: of: there is no material \"redd\"; did you mean \"red\"?"}};
  for (const auto& [call, message] : cases) expect_message(axes + call, message);
  expect_nodes(axes + "axes([1, 2, 3], [0, 0, 2], [[1, 2], [3, 4]], 5);", "show([1,2,3],[0,0,2],[[1,2],[3,4]],5)");
}

// Definitions of files that are used are suggested, and the library's file where none is used.
TEST(Interpret, UnknownOperatorsAreSoughtInLibraries) {
  Options options;
  options.read_file = [](const std::string& path) {
    return path == "mine.vcad" ? std::optional<std::string>("function rings(x) = x;\nmodule stack() {}") : std::nullopt;
  };
  options.library_of = [](std::string_view name) { return name == "honeycomb" ? "ombre/cellular.vcad" : ""; };
  const auto message = [&](const std::string& text) { return first_message("use <mine.vcad>\n" + text, options); };
  EXPECT_EQ(message("cube(ringss(2));"),
            "part.vcad:2:6: error: there is no function \"ringss\"; did you mean \"rings\"?");
  EXPECT_EQ(message("stak();"), "part.vcad:2:1: error: there is no node or module \"stak\"; did you mean \"stack\"?");
  EXPECT_EQ(message("rings(3);"),
            "part.vcad:2:1: error: there is no node or module \"rings\"; it is a function, whose "
            "value stands in an expression or after =");
  EXPECT_EQ(message("cube(stack());"),
            "part.vcad:2:6: error: there is no function \"stack\"; \"stack\" is a node, and "
            "stands in statements only");
  EXPECT_EQ(message("honeycomb(3);"),
            "part.vcad:2:1: error: there is no node or module \"honeycomb\"; a library has it; "
            "write at the top: use <ombre/cellular.vcad>");
  EXPECT_EQ(message("cube(honeycomb(3));"),
            "part.vcad:2:6: error: there is no function \"honeycomb\"; a library has it; "
            "write at the top: use <ombre/cellular.vcad>");
}

TEST(Interpret, LibrariesAreSearchedLast) {
  std::vector<std::string> tried;
  Options options;
  options.libraries = {"/home/me/library", "/usr/share/library"};
  options.read_file = [&](const std::string& path) {
    tried.push_back(path);
    return path == "/usr/share/library/ombre/cells.vcad"
               ? std::optional<std::string>("use <more.vcad>\nfunction f() = g();")
           : path == "/usr/share/library/ombre/more.vcad" ? std::optional<std::string>("function g() = 7;")
                                                          : std::nullopt;
  };
  expect_nodes("use <ombre/cells.vcad>\ncube(f());", "cube(7)", options);
  EXPECT_EQ(tried,
            (std::vector<std::string>{"ombre/cells.vcad", "/home/me/library/ombre/cells.vcad",
                                      "/usr/share/library/ombre/cells.vcad", "/usr/share/library/ombre/more.vcad"}));
  tried.clear();
  EXPECT_EQ(first_message("use <ombre/none.vcad>\ncube(1);", options),
            "part.vcad:1:6: error: there is no file \"ombre/none.vcad\"; looked for ombre/none.vcad and "
            "/home/me/library/ombre/none.vcad and /usr/share/library/ombre/none.vcad");
  tried.clear();
  first_message("use <ombre/../../secret.vcad>\ncube(1);", options);
  EXPECT_EQ(tried, (std::vector<std::string>{"ombre/../../secret.vcad"}));
}

}  // namespace
}  // namespace ombre::lang
