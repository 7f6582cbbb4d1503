#include "lang/syntax/parser.h"

#include <gtest/gtest.h>

#include "lang/syntax/ast_print.h"

namespace ombre::lang {
namespace {

std::string printed(const std::string& text) {
  Diagnostics diagnostics;
  const std::string result = print(parse(make_source("part.vcad", text), diagnostics));
  return diagnostics.has_errors() ? to_text(diagnostics) : result;
}

std::string errors(const std::string& text) {
  Diagnostics diagnostics;
  parse(make_source("part.vcad", text), diagnostics);
  return to_text(diagnostics);
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

TEST(Parser, PrintsExpressionsWithNeededParenthesesOnly) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"a=1+2*3-(4-5);", "a = 1 + 2 * 3 - (4 - 5);\n"},
      {"a=(1+2)*3;", "a = (1 + 2) * 3;\n"},
      {"a=((1));", "a = 1;\n"},
      {"a=-2^2;", "a = -2 ^ 2;\n"},
      {"a=(-2)^2;", "a = (-2) ^ 2;\n"},
      {"a=2^-3^2;", "a = 2 ^ -3 ^ 2;\n"},
      {"a=(2^3)^2;", "a = (2 ^ 3) ^ 2;\n"},
      {"a=!b&&c||d;", "a = !b && c || d;\n"},
      {"a=b&&(c||d);", "a = b && (c || d);\n"},
      {"a=b<c==d;", "a = b < c == d;\n"},
      {"a=b?c:d?e:f;", "a = b ? c : d ? e : f;\n"},
      {"a=(b?c:d)?e:f;", "a = (b ? c : d) ? e : f;\n"},
      {"a=[1,2,[3]];", "a = [1, 2, [3]];\n"},
      {"a=(1,2,(3,4),);", "a = (1, 2, (3, 4));\n"},
      {"a=[0:2];b=[0:.5:2];", "a = [0 : 2];\nb = [0 : 0.5 : 2];\n"},
      {"a=[b?1:2:3];", "a = [b ? 1 : 2 : 3];\n"},
      {"a=f(1,x=2)[3].y;", "a = f(1, x = 2)[3].y;\n"},
      {"a=function(x,y=2)x*y;", "a = function(x, y = 2) x * y;\n"},
      {"a=(function(x)x)(3);", "a = (function(x) x)(3);\n"},
      {"a=let(b=1,c=b)b+c;", "a = let(b = 1, c = b) b + c;\n"},
      {"a=assert(b,\"no\")echo(b)b;", "a = assert(b, \"no\") echo(b) b;\n"},
      {"a=[for(i=[0:2],j=b)if(i>j)i else each j];", "a = [for (i = [0 : 2], j = b) if (i > j) i else each j];\n"},
      {"a=[for(i=0,j=1;i<3;i=i+1)i];", "a = [for (i = 0, j = 1; i < 3; i = i + 1) i];\n"},
      {"a=[if(b)(if(c)1)else 2];", "a = [if (b) (if (c) 1) else 2];\n"},
      {"a=[(let(b=1)for(i=b)i),(let(b=1)b)+1];", "a = [let(b = 1) for (i = b) i, (let(b = 1) b) + 1];\n"},
      {"a=\"q\\\"b\\\\n\\n\";", "a = \"q\\\"b\\\\n\n\";\n"},
      {"a=.5+1e-3+1.;", "a = 0.5 + 0.001 + 1;\n"},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_EQ(printed(text), expected) << text;
    EXPECT_EQ(printed(expected), expected) << text;
  }
}

TEST(Parser, PrintsStatementsReadably) {
  const std::string text = R"(
    use <a/b.vcad>
    include <c.vcad>
    module m(a, b=2) { cube(a); children(); }
    function f(x) = x;
    Union { *cube(1) !#sphere(2) };
    if (a) cube(1); else if (b) { sphere(1); } else for (i=[0:1]) %cube(i);
    F-grade(["x"], [red]) f-rep("x");
    { x = 3 }
  )";
  const std::string expected = R"(use <a/b.vcad>
include <c.vcad>
module m(a, b = 2) {
  cube(a);
  children();
}
function f(x) = x;
Union() {
  *cube(1) {
    !#sphere(2);
  }
}
if (a) {
  cube(1);
} else if (b) {
  sphere(1);
} else {
  for(i = [0 : 1]) {
    %cube(i);
  }
}
F-grade(["x"], [red]) {
  f-rep("x");
}
{
  x = 3;
}
)";
  EXPECT_EQ(printed(text), expected);
  EXPECT_EQ(printed(expected), expected);
}

TEST(Parser, ReadsTheDesignsOfThePapers) {
  EXPECT_EQ(
      errors(
          "root((-2, -2, -3.1415), (2, 2, 3.1415), (.07, .07, .07))\n{\n  fgrade([\"0.2\", \"sin(4.5 * z\n + 1)\"],"
          "[\"blue\",\"cyan\"], \"thresh\")\n  { function(\"(0.5 * (rho * sin(phic) - 0.5)^4 - 1)\", \"red\"); }\n}"),
      "");
  EXPECT_EQ(
      errors("Union{ Rotate(axis = x, deg = 45){ Cube(s = 5, material=\"red\") } Translate(x = 5, y = 10, z = 5){ "
             "Sphere(r = 3, material=\"blue\") } }"),
      "");
}

TEST(Parser, HyphensJoinNamesOnlyWhereACallBegins) {
  EXPECT_EQ(printed("a-b(1);"), "a-b(1);\n");
  EXPECT_EQ(printed("x = a-b;"), "x = a - b;\n");
  EXPECT_EQ(printed("x = a-b(1);"), "x = a - b(1);\n");
  EXPECT_EQ(printed("cube(a-b(1));"), "cube(a - b(1));\n");
  EXPECT_EQ(printed("translate() f-rep{a-b-c();}"), "translate() {\n  f-rep() {\n    a-b-c();\n  }\n}\n");
}

TEST(Parser, TellsWhatWasExpectedWhere) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"x = ;", "part.vcad:1:5: error: expected a value, found \";\"\n  1 | x = ;\n    |     ^\n"},
      {"x = 5\ncube(x);",
       "part.vcad:1:6: error: expected \";\" after this assignment, found \"cube\"\n  1 | x = 5\n    |      ^\n"},
      {"cube(1, 2",
       "part.vcad:1:10: error: expected \",\" or \")\" after this argument, found the end of the file\n"
       "  1 | cube(1, 2\n    |          ^\n"},
      {"cube 5;", "part.vcad:1:6: error: expected \"(\" after \"cube\", found \"5\"\n  1 | cube 5;\n    |      ^\n"},
      {"f - rep();",
       "part.vcad:1:3: error: expected \"(\" after \"f\", found \"-\"; names with a hyphen are written without "
       "spaces\n  1 | f - rep();\n    |   ^\n"},
      {"for = 3;", "part.vcad:1:5: error: expected \"(\" after \"for\", found \"=\"\n  1 | for = 3;\n    |     ^\n"},
      {"x = if;",
       "part.vcad:1:5: error: expected a value, found \"if\"; loops and conditions inside of expressions stand in "
       "list brackets, [for (...) ...]\n  1 | x = if;\n    |     ^~\n"},
      {"else cube();",
       "part.vcad:1:1: error: this \"else\" belongs to no \"if\"; write it right after the if's statement\n"
       "  1 | else cube();\n    | ^~~~\n"},
      {"cube(); }",
       "part.vcad:1:9: error: this \"}\" closes nothing; remove it, or write the \"{\" it belongs to\n"
       "  1 | cube(); }\n    |         ^\n"},
      {"x = 2y;",
       "part.vcad:1:5: error: a number runs into a name; names start with a letter, and a product is written 2 * x\n"
       "  1 | x = 2y;\n    |     ^~\n"},
      {"x = 'a';", "part.vcad:1:5: error: there is no sign \"'\"; write strings between double quotes\n"},
      {"x = \"abc;\ny = 2;",
       "part.vcad:1:5: error: the string is not closed; write \" after its last character\n  1 | x = \"abc;\n    |     "
       "^\n"},
      {"x = 1; /* abc",
       "part.vcad:1:8: error: the comment is not closed; write */ at its end\n  1 | x = 1; /* abc\n"
       "    |        ^~\n"},
      {"x = 1e999;",
       "part.vcad:1:5: error: this number is out of range; numbers reach from 1e-307 to 1e308\n"
       "  1 | x = 1e999;\n    |     ^~~~~\n"},
      {"x = (1,);", "part.vcad:1:5: error: a tuple has at least 2 elements; a list of one is written [a]\n"},
      {"for ([0:2]) cube();",
       "part.vcad:1:6: error: \"for\" gives values to names, and here is no name; write name = value\n"
       "  1 | for ([0:2]) cube();\n    |      ^~~~~\n"},
      {"{ include <a> }",
       "part.vcad:1:3: error: files are included at the top level of a file only; move this line out of "
       "the braces\n  1 | { include <a> }\n    |   ^~~~~~~~~~~\n"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(errors(text).substr(0, expected.size()), expected) << text;
}

TEST(Parser, GoesOnAfterAMistake) {
  Diagnostics diagnostics;
  const ast::File file = parse(
      make_source("part.vcad", "cube(; sphere(1); x = ; { y = [1; } translate(2) { cube(3 } z = 4;"), diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 4u);
  EXPECT_EQ(print(file), "sphere(1);\n{\n}\ntranslate(2) {\n}\nz = 4;\n");
}

TEST(Parser, ReadsStrangeBytes) {
  EXPECT_EQ(printed("\xEF\xBB\xBFx = 1;\r\ny = 2;\r\n"), "x = 1;\ny = 2;\n");
  EXPECT_EQ(printed("// \xFF\xFE\nx = \"\xC3\xA9\";"), "x = \"\xC3\xA9\";\n");
  const std::string nul("x = 1;\0\0cube();", 15);
  EXPECT_NE(errors(nul).find("1:7: error: this is not text in UTF-8"), std::string::npos);
  EXPECT_NE(errors("x = \"a\xFF\";").find("1:7: error: this is not text in UTF-8"), std::string::npos);
  EXPECT_NE(errors("x = \xC3\xA9;").find("cannot contain \"\xC3\xA9\""), std::string::npos);
  EXPECT_NE(errors("x = \"\\q\";").find("warning: this backslash starts no escape"), std::string::npos);
  EXPECT_NE(errors("x = \"\\x80\";").find("error: this escape is no Unicode character"), std::string::npos);
  EXPECT_NE(errors("x = \"\\u12\";").find("error: this escape needs 4 hexadecimal digits"), std::string::npos);
}

TEST(Parser, WarnsWhenAVariableIsSetTwice) {
  EXPECT_EQ(
      errors("union() {\nx = 1;\nx = 2; }"),
      "part.vcad:3:1: warning: \"x\" has a value already from line 2; a variable has one value in its scope, the last "
      "one given\n  3 | x = 2; }\n    | ^\n");
}

TEST(Parser, NestingEndsAtALimitAndLengthDoesNot) {
  const std::string deep = "this nests deeper than 200 levels";
  for (const char* open : {"(", "[", "-", "f(", "a ? ", "let(a = 1) ", "function(x) ", "[for (i = 1) ", "a[", "2^"})
    EXPECT_NE(errors("x = " + repeated(open, 100000) + "1").find(deep), std::string::npos) << open;
  for (const char* open : {"translate() ", "{", "union() {", "if (a) {", "module m() {"})
    EXPECT_NE(errors(repeated(open, 100000)).find(deep), std::string::npos) << open;
  EXPECT_NE(errors("x = a" + repeated("[0]", 100000) + ";").find("follow each other more than 200 times"),
            std::string::npos);
  EXPECT_EQ(errors("x = 1" + repeated(" + 1", 100000) + ";"), "");
  EXPECT_EQ(errors("x = a" + repeated(" ? 1 : a", 100000) + " ? 1 : 2;"), "");
  EXPECT_EQ(errors("if (a) cube();" + repeated(" else if (a) cube();", 100000)), "");
}

}  // namespace
}  // namespace ombre::lang
