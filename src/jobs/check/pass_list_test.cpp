#include "jobs/check/pass_list.h"

#include "jobs/check/emit.h"
#include "jobs/test_designs.h"

namespace ombre::compile {

TEST(PassList, EveryPassIsListedInOrder) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text("sphere(5, \"red\"); translate(3, 0, 0) { cube(4, \"blue\"); }", diagnostics);
  std::vector<std::string> names;
  for (const PassResult& pass : slicing_passes(loaded->design)) {
    names.push_back(pass.name);
    EXPECT_FALSE(pass.program.code.empty());
    EXPECT_FALSE(pass.sentence.empty());
  }
  EXPECT_EQ(names, slicing_pass_names());
}

// The sign of a distance to a ball needs no root; a rotation is a sum of products.
TEST(PassList, FormsPrintWhatAPassMade) {
  Diagnostics diagnostics;
  const LoadedPtr ball = load_text("sphere(5);", diagnostics);
  EXPECT_NE(emit(*ball, "program=after-lower").find("sqrt"), std::string::npos);
  EXPECT_EQ(emit(*ball, "program=after-sign-only").find("sqrt"), std::string::npos);
  const LoadedPtr turned = load_text("rotate(0, 0, 30) { cube(6); }", diagnostics);
  EXPECT_EQ(emit(*turned, "program=after-thresholds").find("fma"), std::string::npos);
  EXPECT_NE(emit(*turned, "program=after-fuse").find("fma"), std::string::npos);
  for (const std::string& name : slicing_pass_names())
    EXPECT_NE(emit(*ball, "passes").find(name), std::string::npos) << name;
}

// Without a box, only the first passes can run.
TEST(PassList, EndsWhereTheDesignHasNoBox) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text("function(\"z\");", diagnostics);
  EXPECT_EQ(slicing_passes(loaded->design).size(), 2u);
}

}  // namespace ombre::compile
