// Tests of JSON text to data and back: values, positions, messages.
#include "base/text/json.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace ombre {
namespace {

std::optional<Data> parse(std::string text) {
  Diagnostics diagnostics;
  return parse_json(make_source("t.json", std::move(text)), diagnostics);
}

// Returns "line:column" of the start and the characters of the range.
std::string place_of(const Data& data) {
  const Place place = data.where.source->place(data.where.begin);
  return std::to_string(place.line) + ':' + std::to_string(place.column) + ' ' +
         std::string(data.where.source->text().substr(data.where.begin, data.where.end - data.where.begin));
}

struct Wrong {
  std::string text;
  int line, column;
  std::string message;  // a part of the message
};

class RandomData {
 public:
  explicit RandomData(unsigned seed) : random_(seed) {}

  Data any(int depth) {
    switch (random_() % (depth > 0 ? 6 : 4)) {
      case 0:
        return {};
      case 1:
        return random_() % 2 == 0;
      case 2:
        return number();
      case 3:
        return text();
      case 4: {
        DataList list;
        for (size_t n = random_() % 5; n > 0; --n) list.push_back(any(depth - 1));
        return list;
      }
      default: {
        DataMembers members;
        for (size_t n = random_() % 5; n > 0; --n) members.emplace_back(text() + std::to_string(n), any(depth - 1));
        return members;
      }
    }
  }

  // Random bits cover all exponents evenly.
  double number() {
    for (;;) {
      const auto value = random_() % 4 == 0 ? static_cast<double>(static_cast<int>(random_() % 2001) - 1000)
                                            : std::bit_cast<double>(random_());
      if (std::isfinite(value)) return value;
    }
  }

  std::string text() {
    static const std::string_view pieces[] = {"a", "Z9", " ", "\"", "\\", "\n", "\t", "\x01",
                                              "é", "漢", "😀", "/",  "{",  "]",  ":"};
    std::string result;
    for (size_t n = random_() % 6; n > 0; --n) result += pieces[random_() % std::size(pieces)];
    return result;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace

TEST(Json, PlacesOfValues) {
  const auto root =
      parse("{\n  \"name\": \"ball\",\n  \"é\": [1.5, -2e3 ,true],\n\t\"deep\" : {\"q\":null,\"e\":\"a\\nb\"}\n}\n");
  ASSERT_TRUE(root);
  EXPECT_EQ(place_of(*root->find("name")), "2:12 ball");
  const DataList& list = *root->find("é")->list();
  EXPECT_EQ(place_of(*root->find("é")), "3:8 [1.5, -2e3 ,true]");
  EXPECT_EQ(place_of(list[0]), "3:9 1.5");
  EXPECT_EQ(place_of(list[1]), "3:14 -2e3");
  EXPECT_EQ(place_of(list[2]), "3:20 true");
  const Data& deep = *root->find("deep");
  EXPECT_EQ(place_of(deep), "4:11 {\"q\":null,\"e\":\"a\\nb\"}");
  EXPECT_EQ(place_of(*deep.find("q")), "4:16 null");
  // The range of a string with escapes includes the quotes, since its characters differ from those in the source.
  EXPECT_EQ(place_of(*deep.find("e")), "4:25 \"a\\nb\"");
  EXPECT_EQ(place_of(*root).substr(0, 5), "1:1 {");
  EXPECT_EQ(root->where.end, root->where.source->text().size() - 1);
}

TEST(Json, PlacesOfLoneValues) {
  for (const std::string value : {"1", "-0.5e1", "true", "null", "[]", "{}", "[[[]]]"}) {
    EXPECT_EQ(place_of(*parse(value)), "1:1 " + value);
    EXPECT_EQ(place_of(*parse(" \r\n\t" + value + " \n")), "2:2 " + value);
  }
  EXPECT_EQ(place_of(*parse(" \"\"")), "1:3 ");
  EXPECT_EQ(place_of(*parse("\"[,]\"")), "1:2 [,]");
  EXPECT_EQ(place_of(parse("[[1],[2],3]")->list()->at(1)), "1:6 [2]");
  EXPECT_EQ(place_of(parse("[{},{\"a\":12}]")->list()->at(1)), "1:5 {\"a\":12}");
}

TEST(Json, MessagesHavePlaces) {
  const Wrong cases[] = {
      {"", 1, 1, "not valid JSON"},
      {"   \n ", 2, 1, "not valid JSON"},
      {"{\"a\": 1,}", 1, 9, "not valid JSON"},
      {"[1, 2", 1, 5, "not valid JSON"},
      {"[1]\n[2]", 2, 1, "not valid JSON"},
      {"[1] x", 1, 5, "not valid JSON"},
      {"{\"a\": nul}", 1, 10, "not valid JSON"},
      {"[01]", 1, 3, "not valid JSON"},
      {"[NaN]", 1, 2, "not valid JSON"},
      {"['a']", 1, 2, "not valid JSON"},
      {"\"a\nb\"", 1, 3, "not valid JSON"},
      {"\"\xff\"", 1, 2, "not valid JSON"},
      {"\"\xc3(\"", 1, 3, "not valid JSON"},
      {"\"\\ud800\"", 1, 8, "not valid JSON"},
      {"[1e999]", 1, 6, "1e999"},
      {"{\"a\": 1,\n \"b\": 2, \"a\": 3}", 2, 10, "the key \"a\" is given twice"},
  };
  for (const Wrong& wrong : cases) {
    Diagnostics diagnostics;
    EXPECT_FALSE(parse_json(make_source("t.json", wrong.text), diagnostics)) << wrong.text;
    ASSERT_EQ(diagnostics.error_count(), 1u) << wrong.text;
    const Diagnostic& error = diagnostics.list()[0];
    const Place place = error.where.source->place(error.where.begin);
    EXPECT_EQ(place.line, wrong.line) << to_text(error);
    // The reader may stop at the wrong character or one before it.
    EXPECT_NEAR(place.column, wrong.column, 1) << to_text(error);
    EXPECT_NE(error.message.find(wrong.message), std::string::npos) << error.message;
    EXPECT_EQ(error.message.find("json.exception"), std::string::npos) << error.message;
  }
}

TEST(Json, DepthIsLimited) {
  const auto nested = [](int depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_TRUE(parse(nested(200)));
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_json(make_source("t.json", nested(201)), diagnostics));
  EXPECT_EQ(diagnostics.list().at(0).where.begin, 200u);
  EXPECT_NE(diagnostics.list()[0].message.find("deeper than 200"), std::string::npos);
  EXPECT_FALSE(parse(std::string(1000000, '[')));
}

TEST(Json, ManyMembers) {
  std::string text = "{";
  for (int i = 0; i < 100000; ++i) text += "\"key" + std::to_string(i) + "\": " + std::to_string(i) + ",";
  const auto root = parse(text + "\"last\": 1}");
  ASSERT_TRUE(root);
  EXPECT_EQ(root->members()->size(), 100001u);
  EXPECT_FALSE(parse(text + "\"key5\": 1}"));
}

TEST(Json, NumbersKeepTheirBits) {
  RandomData random(7);
  for (int i = 0; i < 100000; ++i) {
    const double value = random.number();
    const auto read = parse(print_json_line(value));
    ASSERT_TRUE(read && read->number()) << print_json_line(value);
    if (value == 0) continue;
    EXPECT_EQ(std::bit_cast<uint64_t>(*read->number()), std::bit_cast<uint64_t>(value)) << print_json_line(value);
  }
}

TEST(Json, WholeNumbersAreWhole) {
  const std::pair<double, std::string> cases[] = {{0, "0"},
                                                  {-0.0, "0"},
                                                  {7, "7"},
                                                  {-600, "-600"},
                                                  {1e6, "1000000"},
                                                  {1e15, "1000000000000000"},
                                                  {0x1p53 - 1, "9007199254740991"},
                                                  {-(0x1p53 - 1), "-9007199254740991"},
                                                  {0.1, "0.1"},
                                                  {1e300, "1e+300"},
                                                  {HUGE_VAL, "null"},
                                                  {-HUGE_VAL, "null"},
                                                  {std::nan(""), "null"}};
  for (const auto& [value, text] : cases) EXPECT_EQ(print_json_line(value), text);
}

TEST(Json, PrintsWhatReadsBack) {
  RandomData random(11);
  for (int i = 0; i < 2000; ++i) {
    const Data data = random.any(5);
    EXPECT_EQ(parse(print_json(data)), data) << print_json(data);
    EXPECT_EQ(parse(print_json_line(data)), data) << print_json_line(data);
    EXPECT_EQ(print_json_line(data).find('\n'), std::string::npos);
  }
}

TEST(Json, TextThatIsNotUtf8StaysReadable) {
  const auto read =
      parse(print_json_line(Data(std::string("a\xff"
                                             "b\xc3"))));
  ASSERT_TRUE(read && read->string());
  EXPECT_EQ(*read->string(), "a\uFFFDb\uFFFD");
}

TEST(Json, Escapes) {
  EXPECT_EQ(*parse(R"("\u00e9\ud83d\ude00\/\b\"")")->string(), "é😀/\b\"");
  EXPECT_EQ(*parse(R"("a\u0000b")")->string(), std::string("a\0b", 3));
}

TEST(Data, FindsMembersByName) {
  const auto root = parse(R"({"a": 1, "b": {"a": 2}})");
  EXPECT_EQ(*root->find("a")->number(), 1);
  EXPECT_EQ(*root->find("b")->find("a")->number(), 2);
  EXPECT_EQ(root->find("c"), nullptr);
  EXPECT_EQ(root->find("a")->find("a"), nullptr);
}

TEST(Data, DescribesItself) {
  const std::pair<Data, std::string> cases[] = {{{}, "nothing"},
                                                {true, "true"},
                                                {2.5, "the number 2.5"},
                                                {"ab", "the text \"ab\""},
                                                {DataList{1.0, 2.0, 3.0}, "a list of 3"},
                                                {DataMembers{}, "an object"}};
  for (const auto& [data, text] : cases) EXPECT_EQ(describe(data), text);
  // Long texts are cut at character boundaries.
  std::string accents;
  for (int i = 0; i < 40; ++i) accents += "é";
  const std::string text = describe(accents);
  EXPECT_LT(text.size(), 60u);
  EXPECT_EQ(*parse(print_json_line(text))->string(), text);
}

}  // namespace ombre
