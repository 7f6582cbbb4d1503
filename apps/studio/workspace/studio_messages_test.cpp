#include "studio/workspace/studio_messages.h"

#include <gtest/gtest.h>

namespace ombre::studio {
namespace {

TEST(Messages, RefusesWhatIsNoRequest) {
  for (const char* text :
       {"", "[]", "7", "{\"id\": 1", "{\"id\": \"1\", \"do\": \"x\"}", "{\"id\": 1}", "{\"do\": \"x\"}", "\xff"})
    EXPECT_THROW(parse_request(text), RequestError) << text;
  std::string deep(100000, '[');
  EXPECT_THROW(parse_request(deep), RequestError);
}

TEST(Messages, ReadsMembersByType) {
  const Request request =
      parse_request(R"({"id": 3, "do": "x", "lane": "l", "n": 4, "t": "u", "p": [1, 2, 3], "s": ["a"], "f": true})");
  EXPECT_EQ(request.id, 3);
  EXPECT_EQ(request.lane, "l");
  EXPECT_EQ(request.whole("n", 0, 4), 4);
  EXPECT_THROW(request.whole("n", 0, 3), RequestError);
  EXPECT_EQ(request.text("t"), "u");
  EXPECT_THROW(request.text("n"), RequestError);
  EXPECT_THROW(request.number("t"), RequestError);
  EXPECT_EQ(request.number("missing", 5), 5);
  EXPECT_EQ(request.numbers("p", 3), (std::vector<double>{1, 2, 3}));
  EXPECT_THROW(request.numbers("p", 2), RequestError);
  EXPECT_EQ(request.texts("s"), std::vector<std::string>{"a"});
  EXPECT_THROW(request.texts("p"), RequestError);
  EXPECT_TRUE(request.flag("f"));
  EXPECT_FALSE(request.flag("missing"));
}

TEST(Messages, FramesWithBytesSayWhereTheyBegin) {
  const Frame text = frame_of(1, {{{"a", 2.0}}, ""});
  EXPECT_FALSE(text.is_binary);
  EXPECT_EQ(text.data, R"({"id":1,"a":2})");
  const Frame bytes = frame_of(1, {{}, "PNG"});
  EXPECT_TRUE(bytes.is_binary);
  const std::string json = R"({"id":1})";
  EXPECT_EQ(bytes.data, std::string(1, static_cast<char>(json.size())) + std::string(3, '\0') + json + "PNG");
}

// Units are those of JavaScript: "µ" is one, "😀" two.
TEST(Messages, CountsPlacesAsPagesDo) {
  const std::string text = "aµ😀b";
  const PageOffsets offsets(text);
  EXPECT_EQ(offsets.at(0), 0);
  EXPECT_EQ(offsets.at(1), 1);
  EXPECT_EQ(offsets.at(3), 2);
  EXPECT_EQ(offsets.at(7), 4);
  EXPECT_EQ(offsets.at(8), 5);
  EXPECT_EQ(offsets.at(1000), 5);
  std::string many;
  for (int n = 0; n < 1000; ++n) many += "µ";
  EXPECT_EQ(PageOffsets(many).at(2 * 777), 777);
}

}  // namespace
}  // namespace ombre::studio
