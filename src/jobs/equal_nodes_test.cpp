// Tests that equal nodes that a script makes again and again become one node.
#include "jobs/test_designs.h"

namespace ombre::compile {
namespace {

size_t node_count(const std::string& text) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(text, diagnostics);
  EXPECT_TRUE(loaded) << to_text(diagnostics);
  return loaded ? design::topological(loaded->design.roots()).size() : 0;
}

}  // namespace

TEST(EqualNodes, BecomeOneHoweverOftenTheyAreMade) {
  EXPECT_EQ(node_count("union() for (i = [0:999]) translate((3 * (i % 5), 0, 0)) sphere(1);"), 1 + 5 + 1);
}

TEST(EqualNodes, StayOneAmongVeryManyOthers) {
  constexpr size_t count = 120000;  // more than are remembered
  EXPECT_EQ(node_count("union() for (i = [1:" + std::to_string(count) + "]) { sphere(1); sphere(i); }"), 1 + count);
}

TEST(EqualNodes, AreTwoWhereFormulasOrTheirListsDiffer) {
  EXPECT_EQ(
      node_count("union() for (i = [0:3]) fgrade([i % 2 == 0 ? \"x\" : \"y\", \"1\"], [\"red\", \"blue\"]) sphere(1);"),
      1 + 2 + 1);
  EXPECT_EQ(node_count("union() for (m = [\"red\", \"blue\", \"red\"]) material([m, \"cyan\"]) sphere(1);"), 1 + 2 + 1);
}

}  // namespace ombre::compile
