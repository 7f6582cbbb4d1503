#include "formats/containers/base64.h"

#include <gtest/gtest.h>

namespace ombre::formats {

// The texts of RFC 4648, section 10.
TEST(Base64, TextsOfTheStandard) {
  const std::pair<const char*, const char*> texts[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : texts) {
    EXPECT_EQ(to_base64(bytes), text);
    EXPECT_EQ(from_base64(text), bytes);
  }
  const std::string high("\xff\xfe\x80", 3);
  EXPECT_EQ(from_base64(to_base64(high)), high);
}

}  // namespace ombre::formats
