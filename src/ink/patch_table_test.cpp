// Tests of CSV files of measured patches.
#include "ink/patch_table.h"

#include <gtest/gtest.h>

#include "base/text/error.h"

namespace ombre::ink {
namespace {

std::string message_of(const std::string& text) {
  try {
    read_patches("patches.csv", text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(PatchTable, HasPatchesOfItsMaterials) {
  const PatchTable table = read_patches("p.csv",
                                        "# our lot\npatch, C, W, L, a, b\n1, 0, 1, 95, 0, 2\n2, 1, 0, 50, -40, "
                                        "-50\n3, 0.5, 0.5, 70, -20, -30\n4, 0.5, 0.5, 72, -22, -34\n");
  EXPECT_EQ(table.materials, (std::vector<std::string>{"C", "W"}));
  ASSERT_EQ(table.patches.size(), 3U);
  EXPECT_EQ(table.patches[1].shares, (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(table.patches[1].colour.x, 71);  // the mean of both
  EXPECT_EQ(table.patches[1].colour.z, -32);
  EXPECT_EQ(read_patches("p.csv", "L;a;b;C;W\n95;0;2;0;1\n50;-40;-50;1;0").patches.size(), 2U);
}

TEST(PatchTable, SaysWhatIsWrongAndWhere) {
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_NE(message_of(text).find(part), std::string::npos) << text << "\ngave: " << message_of(text);
  };
  expect("C,W,L,a\n", "patches.csv:1: the first line has no column b");
  expect("C,W,L,a,b\n0.5,0.6,1,2,3\n", "patches.csv:2: the shares add up to 1.1");
  expect("C,W,L,a,b\n-0.5,1.5,1,2,3\n", "one is negative");
  expect("C,W,L,a,b\n0.5,x,1,2,3\n", "patches.csv:2: \"x\" in the column W is no number");
  expect("C,W,L,a,b\n0.5,0.5,1,2\n", "this line has 4 values for 5 columns");
  expect("C,W,L,a,b\n0.5,0.5,101,2,3\n", "L is 101");
  expect("C,W,L,a,b\n0.5,0.5,1,2,3\n", "no patch is C alone");
  expect("W,L,a,b\n1,1,2,3\n", "it has 1 materials");
  expect("", "it has no patches");
}

}  // namespace
}  // namespace ombre::ink
