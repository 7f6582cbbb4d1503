#include "studio/workspace/guard.h"

#include <gtest/gtest.h>

namespace ombre::studio {
namespace {

const std::string token = "0123456789abcdef0123456789abcdef";

RequestHead head(const std::string& host, const std::string& origin = "",
                 const std::string& target = "/?token=" + token) {
  return {"GET", target, host, origin, ""};
}

bool is_let_in(const RequestHead& request) { return !Guard(token).refuse(request); }

TEST(Guard, LetsInNamesOfThisMachineAtAnyPort) {
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "[::1]:8080", "localhost:9999", "127.0.0.1", "[::1]"})
    EXPECT_TRUE(is_let_in(head(host))) << host;
}

TEST(Guard, RefusesNamesThatOthersMakePointHere) {
  for (const char* host :
       {"", "evil.example:8080", "127.0.0.1.evil.example", "localhost.evil.example:8080", "192.168.1.7:8080",
        "localhost:80x", "localhost:", "[::1]evil:80", "localhost:123456", "127.0.0.1:8080, evil"})
    EXPECT_FALSE(is_let_in(head(host))) << host;
}

TEST(Guard, RefusesPagesOfOthers) {
  EXPECT_TRUE(is_let_in(head("localhost:8080", "http://localhost:8080")));
  for (const char* origin :
       {"http://evil.example", "null", "http://localhost:8081", "https://localhost:8080", "http://127.0.0.1:8080"})
    EXPECT_FALSE(is_let_in(head("localhost:8080", origin))) << origin;
}

TEST(Guard, NeedsTheTokenInOneOfTwoPlaces) {
  RequestHead request = head("localhost:8080", "", "/api");
  EXPECT_FALSE(is_let_in(request));
  request.authorization = "Bearer " + token;
  EXPECT_TRUE(is_let_in(request));
  request.authorization = "Bearer " + token.substr(1);
  EXPECT_FALSE(is_let_in(request));
  for (const std::string& target :
       {std::string("/?token="), "/?token=" + token + "0", "/?tokens=" + token, std::string("/?a=b")})
    EXPECT_FALSE(is_let_in(head("localhost:8080", "", target))) << target;
  EXPECT_TRUE(is_let_in(head("localhost:8080", "", "/?a=b&token=" + token)));
}

// The page's own files hold no secret, so they need no token; foreign names and pages get them neither.
TEST(Guard, TellsForeignRequests) {
  EXPECT_FALSE(Guard::refuse_foreign(head("localhost:8080", "", "/app.js")));
  EXPECT_TRUE(Guard::refuse_foreign(head("evil.example:8080", "", "/app.js")));
  EXPECT_TRUE(Guard::refuse_foreign(head("localhost:8080", "http://localhost:8081", "/app.js")));
}

TEST(Guard, TokensAreRandom) {
  const std::string first = random_token();
  EXPECT_EQ(first.size(), 32U);
  EXPECT_EQ(first.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(first, random_token());
}

TEST(Guard, ReadsTargets) {
  EXPECT_EQ(path_of("/a/b?c=d"), "/a/b");
  EXPECT_EQ(query_value("/a?c=d&e=f", "e"), "f");
  EXPECT_EQ(query_value("/a?c=d&&e=f", "e"), "f");
  EXPECT_EQ(query_value("/a", "e"), "");
}

}  // namespace
}  // namespace ombre::studio
