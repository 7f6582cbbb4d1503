#include "sources/file_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ombre::sources {
namespace {

TEST(FileNumbers, OrderNamesAsPeopleCount) {
  const std::vector<std::string> wanted{"a1", "a2", "a007", "a10", "a10b2", "a10b11", "b", "b0"};
  std::vector<std::string> names = wanted;
  std::ranges::reverse(names);
  std::ranges::sort(names, is_numbered_before);
  EXPECT_EQ(names, wanted);
  EXPECT_FALSE(is_numbered_before("a1", "a1"));
  // Names that differ only in leading zeros have a defined order, too.
  EXPECT_NE(is_numbered_before("a01", "a1"), is_numbered_before("a1", "a01"));
}

TEST(FileNumbers, TellTheFirstGap) {
  EXPECT_FALSE(missing_number({"s1.png", "s2.png", "s3.png"}));
  EXPECT_EQ(missing_number({"s1.png", "s2.png", "s5.png", "s7.png"}), 3);
  EXPECT_FALSE(missing_number({"left.png", "right.png"}));
  EXPECT_FALSE(missing_number({"v2_0009.png", "v2_0010.png"}));
}

}  // namespace
}  // namespace ombre::sources
