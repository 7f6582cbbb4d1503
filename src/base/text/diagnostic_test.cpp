// Tests of the text of diagnostics: position, message, source line, marker.
#include "base/text/diagnostic.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "base/text/text.h"

namespace ombre {
namespace {

std::string shown(const std::string& text, uint32_t begin, uint32_t end) {
  return to_text(Diagnostic{Severity::error, {make_source("part.vcad", text), begin, end}, "wrong", ""});
}

size_t code_points(std::string_view text) {
  size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return count;
}

}  // namespace

TEST(Diagnostic, CaretLines) {
  struct {
    std::string text;
    uint32_t begin, end;
    std::string expected;
  } const cases[] = {
      {"torus(radius=3);", 6, 12, "part.vcad:1:7: error: wrong\n  1 | torus(radius=3);\n    |       ^~~~~~\n"},
      {"a\n\tb = c;", 7, 8, "part.vcad:2:6: error: wrong\n  2 | \tb = c;\n    | \t    ^\n"},
      {"é = ü + x;", 10, 11, "part.vcad:1:9: error: wrong\n  1 | é = ü + x;\n    |         ^\n"},
      {"\"漢字\"", 0, 8, "part.vcad:1:1: error: wrong\n  1 | \"漢字\"\n    | ^~~~\n"},
      {"x = 1;\r\ny = ;\r\n", 12, 13, "part.vcad:2:5: error: wrong\n  2 | y = ;\n    |     ^\n"},
      {"abc", 3, 3, "part.vcad:1:4: error: wrong\n  1 | abc\n    |    ^\n"},  // at the end of the text
      {"abc\n", 4, 4, "part.vcad:2:1: error: wrong\n"},                       // in an empty last line
      {"ab", 0, 0, "part.vcad: error: wrong\n"},                              // about the whole source
      {"", 0, 0, "part.vcad: error: wrong\n"},
      {"ab\ncd", 1, 4, "part.vcad:1:2: error: wrong\n  1 | ab\n    |  ^\n"},  // a range over two lines
      {"ab", 0, 1, "part.vcad:1:1: error: wrong\n  1 | ab\n    | ^\n"},
  };
  for (const auto& c : cases) EXPECT_EQ(shown(c.text, c.begin, c.end), c.expected);
}

TEST(Diagnostic, LongLinesAreCutAroundTheMistake) {
  for (const std::string& filler : {std::string("a"), std::string("é"), std::string("漢")}) {
    std::string text;
    for (int i = 0; i < 5000; ++i) text += filler;
    for (const uint32_t at : {0, 1, 10, 79, 80, 81, 160, 2500, 4999, 5000}) {
      for (const uint32_t length : {1, 100, 5000}) {
        const auto size = static_cast<uint32_t>(filler.size());
        const std::vector<std::string> lines = split(shown(text, at * size, std::min(5000u, at + length) * size), '\n');
        ASSERT_EQ(lines.size(), 4u);
        EXPECT_EQ(lines[0], "part.vcad:1:" + std::to_string(at + 1) + ": error: wrong");
        const std::string source = lines[1].substr(6), caret = lines[2].substr(6);
        EXPECT_LE(code_points(source), 165u);
        // Only whole characters are shown.
        EXPECT_EQ(source.size() % size, 0u);
        EXPECT_EQ(code_points(source) * size, source.size());
        // The marker lies below the text that is shown, or right after it.
        EXPECT_LE(caret.find('^'), code_points(source));
        EXPECT_LE(caret.size(), code_points(source) + 1);
      }
    }
  }
}

TEST(Diagnostic, ControlCharactersDoNotReachTheTerminal) {
  const std::string text = shown(std::string("a = \x1b[31m\0 b\x7f;", 13), 4, 5);
  for (const char c : text) EXPECT_TRUE(c == '\n' || (static_cast<unsigned char>(c) >= 32 && c != 127)) << int{c};
}

TEST(Diagnostic, HintsAndSeverities) {
  EXPECT_EQ(to_text(Diagnostic{Severity::warning, {}, "odd", ""}), "warning: odd\n");
  EXPECT_EQ(to_text(Diagnostic{Severity::note, {}, "so", ""}), "note: so\n");
  EXPECT_EQ(to_text(Diagnostic{Severity::error, {}, "wrong", "write this"}), "error: wrong; write this\n");
}

TEST(Diagnostic, HintsAreInTheLanguageOfTheDesign) {
  const Phrase hint = "write " + spelled::parameter("angle", "90") + ", or " + spelled::option("--cell", "1");
  const auto worded_for = [&](const char* file, FrontEnd front_end) {
    return sentence_of(Diagnostic{Severity::error, {make_source(file, ""), 0, 0}, "wrong", hint}, front_end);
  };
  EXPECT_EQ(worded_for("a.vcad", FrontEnd::command_line), "wrong; write angle=90, or --cell 1");
  EXPECT_EQ(worded_for("a.json", FrontEnd::command_line), "wrong; write \"angle\": 90, or --cell 1");
  EXPECT_EQ(worded_for("a.py", FrontEnd::python), "wrong; write angle=90, or cell=1");
  EXPECT_EQ(worded_for("a.vcad", FrontEnd::studio), "wrong; write angle=90, or cell 1");
}

TEST(Diagnostics, CodesAreReportedOnce) {
  Diagnostics diagnostics;
  diagnostics.error({}, "before");
  const size_t known = diagnostics.list().size();
  diagnostics.error({}, "plain");
  diagnostics.error(Code::file_missing, {}, "there is no file", {}, {{"file", "a.stl"}});
  diagnostics.error(Code::limit, {}, "too many");
  diagnostics.tell_code(known, Code::parameters, {{"node", "mesh"}});
  const auto& list = diagnostics.list();
  EXPECT_EQ(list[0].code, Code::design);
  EXPECT_EQ(list[1].code, Code::parameters);
  EXPECT_EQ(list[1].values, (CodeValues{{"node", "mesh"}}));
  EXPECT_EQ(list[2].code, Code::file_missing);
  EXPECT_EQ(list[2].values, (CodeValues{{"file", "a.stl"}}));
  EXPECT_EQ(list[3].code, Code::limit);
}

TEST(Code, NamesAreWordsWithHyphens) {
  std::set<std::string_view> names;
  for (const CodeInfo& info : codes()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_EQ(info.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string_view::npos) << info.name;
    EXPECT_EQ(name_of(info.code), info.name);
    EXPECT_FALSE(info.sentence.empty()) << info.name;
  }
}

TEST(Diagnostics, CountAllOfOthers) {
  Diagnostics first, second, all;
  for (int n = 0; n < 15; ++n) first.error({}, "first");
  for (int n = 0; n < 30; ++n) second.error({}, "second");
  second.warning({}, "warned");
  all.add_all(first);
  all.add_all(second);
  EXPECT_EQ(all.error_count(), 45u);
  ASSERT_EQ(all.list().size(), Diagnostics::most + 1);
  EXPECT_EQ(all.list()[14].message, "first");
  EXPECT_EQ(all.list()[15].message, "second");
  EXPECT_EQ(all.list().back().message, "warned");
}

TEST(Diagnostics, KeepsTheFirstErrorsAndCountsAll) {
  Diagnostics diagnostics;
  EXPECT_FALSE(diagnostics.has_errors());
  diagnostics.warning({}, "odd");
  diagnostics.note({}, "so");
  EXPECT_FALSE(diagnostics.has_errors());
  for (int i = 0; i < 1000; ++i) diagnostics.error({}, "wrong " + std::to_string(i));
  EXPECT_EQ(diagnostics.error_count(), 1000u);
  EXPECT_EQ(diagnostics.list().size(), 2 + Diagnostics::most);
  const std::string text = to_text(diagnostics);
  EXPECT_NE(text.find("wrong 19\n"), std::string::npos);
  EXPECT_EQ(text.find("wrong 20\n"), std::string::npos);
  EXPECT_NE(text.find("and 980 more errors"), std::string::npos);
}

}  // namespace ombre
