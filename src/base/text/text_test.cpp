#include "base/text/text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

namespace ombre {
namespace {

using Strings = std::vector<std::string>;
constexpr double inf = std::numeric_limits<double>::infinity();

}  // namespace

TEST(FormatNumber, IsShortest) {
  const std::pair<double, std::string> cases[] = {{0.1, "0.1"},    {1.0 / 3, "0.3333333333333333"},
                                                  {1e21, "1e+21"}, {5e-324, "5e-324"},
                                                  {100, "100"},    {0.1 + 0.2, "0.30000000000000004"},
                                                  {-2.5, "-2.5"},  {inf, "inf"},
                                                  {-inf, "-inf"},  {std::nan(""), "nan"}};
  for (const auto& [value, text] : cases) EXPECT_EQ(format_number(value), text);
}

TEST(FormatNumber, ReadsBackToTheSameBits) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 200000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    const std::string text = format_number(value);
    EXPECT_EQ(std::bit_cast<uint64_t>(std::strtod(text.c_str(), nullptr)), std::bit_cast<uint64_t>(value)) << text;
    EXPECT_LE(text.size(), 24u);  // sign, 17 digits, point, e-308
    EXPECT_EQ(parse_number(text), value) << text;
  }
}

TEST(FormatRounded, ForPeople) {
  const std::pair<double, std::string> cases[] = {{1.0 / 3, "0.3333"}, {2.0, "2"},      {0.25, "0.25"},
                                                  {1e6, "1000000"},    {0, "0"},        {-1.5, "-1.5"},
                                                  {inf, "inf"},        {1e-9, "1e-09"}, {99999, "99999"}};
  for (const auto& [value, text] : cases) EXPECT_EQ(format_rounded(value), text);
  EXPECT_EQ(format_rounded(3.14159, 2), "3.1");
}

TEST(FormatCount, GroupsThousands) {
  const std::pair<unsigned long long, std::string> cases[] = {{0, "0"},
                                                              {7, "7"},
                                                              {999, "999"},
                                                              {1000, "1,000"},
                                                              {12345, "12,345"},
                                                              {123456, "123,456"},
                                                              {1234567, "1,234,567"},
                                                              {18446744073709551615ull, "18,446,744,073,709,551,615"}};
  for (const auto& [count, text] : cases) EXPECT_EQ(format_count(count), text);
}

TEST(ParseNumber, TakesOneDecimalNumber) {
  const std::pair<std::string, double> cases[] = {{"1", 1},      {"-1.5", -1.5},  {"+2", 2},
                                                  {"1e3", 1000}, {".5", 0.5},     {"5.", 5},
                                                  {"-0", -0.0},  {"1E-3", 0.001}, {"007", 7}};
  for (const auto& [text, value] : cases) EXPECT_EQ(parse_number(text), value) << text;
  for (const char* text :
       {"",    " ",    "+",   "-",        "+-5",   "-+5",    "++5", "--5", " 1", "1 ",    "1a",    "0x10",    "1,5",
        "inf", "-inf", "nan", "infinity", "1e999", "-1e999", "1e",  ".",   "e5", "1.2.3", "1_000", "\xd9\xa1"})
    EXPECT_FALSE(parse_number(text)) << text;
  EXPECT_FALSE(parse_number(std::string_view("1\0", 2)));
}

TEST(FoldName, SpellingsOfOneName) {
  for (const char* name : {"F-grade", "f_grade", "fgrade", "FGRADE", "F_-Grade", "-fgrade_"})
    EXPECT_EQ(fold_name(name), "fgrade");
  EXPECT_EQ(fold_name(""), "");
  EXPECT_EQ(fold_name("É"), "É");  // only ASCII letters are folded
  EXPECT_EQ(to_lower("F-Grade É"), "f-grade É");
}

TEST(ClosestName, TypicalSlips) {
  const Strings names{"sphere", "cube", "rectprism", "cylinder", "strut", "translate", "union", "ring", "tube", "x"};
  const std::pair<std::string, std::string> slips[] = {{"spere", "sphere"},        {"shpere", "sphere"},
                                                       {"Sphere", "sphere"},       {"cylnder", "cylinder"},
                                                       {"cilinder", "cylinder"},   {"rect_prism", "rectprism"},
                                                       {"transalte", "translate"}, {"unoin", "union"},
                                                       {"strutt", "strut"},        {"rings", "ring"}};
  for (const auto& [slip, meant] : slips) EXPECT_EQ(closest_name(slip, names), meant) << slip;
  for (const char* far : {"gyroid", "banana", "zzzzzzzz", "", "sp"})
    EXPECT_FALSE(closest_name(far, Strings{"sphere", "cylinder"})) << far;
  EXPECT_FALSE(closest_name("sphere", {}));
  EXPECT_FALSE(closest_name(std::string(1000000, 'a'), names));
}

TEST(ClosestName, TheNearestWinsAndTheFirstOnTies) {
  EXPECT_EQ(closest_name("rad", Strings{"red", "rad", "bad"}), "rad");
  EXPECT_EQ(closest_name("rid", Strings{"red", "rad"}), "red");
  EXPECT_EQ(did_you_mean("rin", Strings{"ring"}), "did you mean \"ring\"?");
  EXPECT_EQ(did_you_mean("wheel", Strings{"ring"}), "");
}

TEST(JoinAndSplit, AreInverse) {
  for (const Strings& parts : {Strings{"a"}, {"a", "b"}, {"", "a"}, {"a", "", "b"}, {"", "", ""}, {"a", ""}, {""}})
    EXPECT_EQ(split(join(parts, ","), ','), parts);
  EXPECT_EQ(join(Strings{}, ", "), "");
  EXPECT_EQ(join(Strings{"a", "b", "c"}, ", "), "a, b, c");
}

TEST(WordsText, PutsOrBeforeTheLast) {
  EXPECT_EQ(words_text(Strings{"red", "green", "blue"}), "red, green or blue");
  EXPECT_EQ(words_text(Strings{"red", "green"}), "red or green");
  EXPECT_EQ(words_text(Strings{"red"}), "red");
  EXPECT_EQ(words_text(Strings{}), "");
}

TEST(Trim, OuterBlanksAlone) {
  const std::pair<std::string, std::string> cases[] = {
      {" a b ", "a b"}, {"\t\r\na\n", "a"}, {"", ""}, {" \n ", ""}, {"a", "a"}};
  for (const auto& [text, trimmed] : cases) EXPECT_EQ(trim(text), trimmed);
}

}  // namespace ombre
