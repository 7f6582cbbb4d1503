// Tests of designs with their files: bundles, and copies of examples.
#include <algorithm>
#include <filesystem>

#include "base/text/json.h"
#include "studio/test_studio.h"

namespace ombre::studio {
namespace {

TEST_F(StudioTest, MakesAndOpensBundles) {
  folder.write("shapes/a.vcad", "include <b.vcad>\nsphere(r);\n");
  folder.write("shapes/b.vcad", "r = 2;\n");
  const auto [made, bytes] = ask("bundle", R"("file": "shapes/a.vcad")");
  if (print_json(made).find("-DOMBRE_3MF=ON") != std::string::npos) GTEST_SKIP();
  EXPECT_EQ(*made.find("files"), Data(DataList{"a.vcad", "b.vcad"})) << print_json(made);
  const auto open = [&](const std::string& bundle) {
    return ask("unbundle", R"("name": "gift.ombre", "bytes": ")" + to_base64(bundle) + '"').first;
  };
  EXPECT_EQ(text(open(bytes), "file"), "gift/a.vcad");
  EXPECT_EQ(text(open(bytes), "file"), "gift_2/a.vcad");
  EXPECT_EQ(folder.read("gift_2/b.vcad"), "r = 2;\n");
  EXPECT_EQ(text(open(bytes.substr(0, bytes.size() / 2)), "error"), "design");
  EXPECT_FALSE(std::filesystem::exists(folder.path / "gift_3"));
  EXPECT_EQ(text(ask("unbundle", R"("name": "../../x.ombre", "bytes": "!")").first, "error"), "request");
  EXPECT_EQ(text(ask("bundle", R"("file": "../a.vcad")").first, "error"), "name");
}

// The example reads a mesh of a gear from a folder beside it.
TEST_F(StudioTest, OpensCopiesOfExamples) {
  const Data examples = ask("examples").first;
  ASSERT_TRUE(examples.find("examples")) << print_json(examples);
  const DataList& list = *examples.find("examples")->list();
  EXPECT_TRUE(std::ranges::any_of(list, [](const Data& e) {
    return text(e, "name") == "gear" && text(e, "sentence").starts_with("A gear from a mesh");
  }));
  const Data opened = ask("open_example", R"("name": "gear")").first;
  if (print_json(opened).find("-DOMBRE_3MF=ON") != std::string::npos) GTEST_SKIP();
  EXPECT_EQ(text(opened, "file"), "gear/gear.vcad") << print_json(opened);
  EXPECT_TRUE(std::filesystem::exists(folder.path / "gear/models/gear.stl"));
  EXPECT_EQ(text(ask("open_example", R"("name": "../gear")").first, "error"), "name");
  EXPECT_EQ(text(ask("open_example", R"("name": "nothing")").first, "error"), "name");
}

}  // namespace
}  // namespace ombre::studio
