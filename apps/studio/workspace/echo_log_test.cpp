#include "studio/workspace/echo_log.h"

#include <gtest/gtest.h>

namespace ombre::studio {
namespace {

TEST(EchoLog, CountsWhatItLeavesOut) {
  EchoLog log;
  for (int n = 0; n < 300; ++n) log.add("line " + std::to_string(n));
  const DataList lines = log.lines();
  ASSERT_EQ(lines.size(), EchoLog::most_lines + 1);
  EXPECT_EQ(lines.front(), Data("line 0"));
  EXPECT_EQ(lines.back(), Data("... and 100 more lines"));
}

TEST(EchoLog, CutsGiantLines) {
  EchoLog log;
  const std::string giant(16 << 20, 'x');
  for (int n = 0; n < 100; ++n) log.add(giant);
  size_t bytes = 0;
  for (const Data& line : log.lines()) bytes += line.string()->size();
  EXPECT_LT(bytes, EchoLog::most_bytes + (16 << 10));
  EXPECT_TRUE(log.lines().front().string()->ends_with("... (16773120 more bytes)"));  // 16 MiB less 4096
}

TEST(EchoLog, CutsBetweenCharacters) {
  EXPECT_EQ(beginning_of("aµ", 2), "a");
  EXPECT_EQ(beginning_of("aµ", 3), "aµ");
  EXPECT_EQ(beginning_of("µµ", 3), "µ");
}

}  // namespace
}  // namespace ombre::studio
