// Tests of lines and columns. Columns count code points, a tab counts as one, and lines end with "\n", "\r\n" or "\r".
#include "base/text/source_text.h"

#include <gtest/gtest.h>

#include <random>

namespace ombre {
namespace {

struct Expected {
  std::string text;
  size_t offset;
  int line, column;
};

}  // namespace

TEST(SourceText, Places) {
  const Expected cases[] = {
      {"", 0, 1, 1},        {"", 99, 1, 1},        {"abc", 2, 1, 3},      {"abc", 3, 1, 4},    {"abc", 99, 1, 4},
      {"a\nb", 1, 1, 2},    {"a\nb", 2, 2, 1},     {"a\n", 2, 2, 1},      {"a\r\nb", 3, 2, 1}, {"a\r\nb", 2, 1, 3},
      {"\n\n\nx", 3, 4, 1}, {"\tx", 1, 1, 2},      {"é=1", 2, 1, 2},      {"é=1", 3, 1, 3},    {"漢字x", 6, 1, 3},
      {"😀x", 4, 1, 2},      {"x\n漢\tx", 6, 2, 3}, {"a\rb", 1, 1, 2},     {"a\rb", 2, 2, 1},   {"a\r\rb", 3, 3, 1},
      {"a\n\rb", 3, 3, 1},  {"a\r", 2, 2, 1},      {"a\r\n\rb", 4, 3, 1},
  };
  for (const Expected& e : cases) {
    const Place place = SourceText("t", e.text).place(e.offset);
    EXPECT_EQ(place.line, e.line) << e.text << " at " << e.offset;
    EXPECT_EQ(place.column, e.column) << e.text << " at " << e.offset;
  }
}

TEST(SourceText, Lines) {
  const SourceText source("t", "one\r\ntwo\n\nfour");
  EXPECT_EQ(source.line(1), "one");
  EXPECT_EQ(source.line(2), "two");
  EXPECT_EQ(source.line(3), "");
  EXPECT_EQ(source.line(4), "four");  // without its line ending
  for (const int number : {0, -1, 5, 1 << 30}) EXPECT_EQ(source.line(number), "");
  const SourceText old("t", "one\rtwo\r\rfour\r\nfive");
  EXPECT_EQ(old.line(1), "one");
  EXPECT_EQ(old.line(3), "");
  EXPECT_EQ(old.line(4), "four");
  EXPECT_EQ(old.line(5), "five");
  EXPECT_EQ(SourceText("t", "").line(1), "");
  EXPECT_EQ(SourceText("t", "\n").line(2), "");
  EXPECT_EQ(SourceText("t", "\r\n").line(1), "");
}

TEST(SourceText, PlacesAgreeWithCounting) {
  std::mt19937 random(5);
  std::string text;
  for (int i = 0; i < 2000; ++i) text += "abc \t\n"[random() % 6];
  const SourceText source("t", text);
  int line = 1, column = 1;
  for (size_t i = 0; i < text.size(); ++i) {
    const Place place = source.place(i);
    ASSERT_EQ(place.line, line);
    ASSERT_EQ(place.column, column);
    if (text[i] != '\n') {
      EXPECT_EQ(source.line(line)[column - 1], text[i]);
    }
    ++column;
    if (text[i] == '\n') ++line, column = 1;
  }
}

TEST(SourceText, LongLinesAreQuick) {
  // Looks up every character of 2 MB, which would take too long if each look-up counted from the start of the line.
  std::string text;
  for (int i = 0; i < 1000000; ++i) text += "é";
  const SourceText source("t", text);
  for (int i = 0; i <= 1000000; i += 7) ASSERT_EQ(source.place(2 * i).column, i + 1);
}

TEST(SourceRange, Parts) {
  const SourceRange range{make_source("t", "0123456789"), 2, 8};
  const SourceRange part = range.part(1, 3);
  EXPECT_EQ(part.begin, 3u);
  EXPECT_EQ(part.end, 5u);
  EXPECT_EQ(part.source, range.source);
}

}  // namespace ombre
