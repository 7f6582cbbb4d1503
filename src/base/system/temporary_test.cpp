#include "base/system/temporary.h"

#include <gtest/gtest.h>

#include <string>

namespace ombre {
namespace {

TEST(Temporary, TheFormerValueComesBack) {
  std::string name = "a";
  {
    const Temporary outer(name, "b");
    EXPECT_EQ(name, "b");
    {
      const Temporary inner(name, name + "c");
      EXPECT_EQ(name, "bc");
    }
    EXPECT_EQ(name, "b");
  }
  EXPECT_EQ(name, "a");
}

TEST(Temporary, TheFormerValueComesBackAfterAnException) {
  int depth = 3;
  const auto fail = [&] {
    const Temporary level(depth, depth + 1);
    throw depth;
  };
  EXPECT_THROW(fail(), int);
  EXPECT_EQ(depth, 3);
}

}  // namespace
}  // namespace ombre
