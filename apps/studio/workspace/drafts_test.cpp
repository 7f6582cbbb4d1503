#include "studio/workspace/drafts.h"

#include <gtest/gtest.h>

#include "studio/workspace/state_folder.h"
#include "studio/workspace/studio_messages.h"
#include "studio/workspace/test_folder.h"

namespace ombre::studio {
namespace {

TEST(Drafts, OutliveTheServer) {
  const TestFolder folder;
  {
    Drafts drafts(folder.path / "drafts");
    drafts.keep({"a.vcad", "old", "v1"});
    drafts.keep({"a.vcad", "sphere(3);\n\"µ\"", "v2"});
    drafts.keep({"untitled.vcad", "cube(1);", ""});
  }
  Drafts drafts(folder.path / "drafts");
  const auto found = drafts.find("a.vcad");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->text, "sphere(3);\n\"µ\"");
  EXPECT_EQ(found->version, "v2");
  EXPECT_GT(found->time, 1e9);
  ASSERT_EQ(drafts.list().size(), 2U);
  EXPECT_EQ(drafts.list().front().file, "untitled.vcad");  // the newest
  drafts.rename("a.vcad", "parts/b.vcad");
  EXPECT_FALSE(drafts.find("a.vcad"));
  EXPECT_EQ(drafts.find("parts/b.vcad")->version, "v2");
  drafts.remove("parts/b.vcad");
  EXPECT_FALSE(drafts.find("parts/b.vcad"));
  EXPECT_EQ(drafts.list().size(), 1U);
}

TEST(Drafts, CanBeReadByThisUserAlone) {
  const TestFolder folder;
  Drafts drafts(folder.path / "state/drafts");
  drafts.keep({"a.vcad", "text", ""});
  EXPECT_EQ(std::filesystem::status(folder.path / "state/drafts").permissions(), std::filesystem::perms::owner_all);
}

TEST(Drafts, PassOverWhatIsNone) {
  const TestFolder folder;
  folder.write("drafts/0.json", "{\"file\": 3}");
  folder.write("drafts/1.json", "{");
  folder.write("drafts/2.json", "[[[[");
  std::filesystem::create_directories(folder.path / "drafts/3.json");
  EXPECT_TRUE(Drafts(folder.path / "drafts").list().empty());
}

TEST(Drafts, AreBounded) {
  const TestFolder folder;
  Drafts drafts(folder.path);
  EXPECT_THROW(drafts.keep({"a.vcad", std::string(Drafts::most_bytes + 1, 'x'), ""}), RequestError);
  for (size_t n = 0; n < Drafts::most; ++n) drafts.keep({std::to_string(n), "x", ""});
  EXPECT_THROW(drafts.keep({"one more", "x", ""}), RequestError);
  drafts.keep({"7", "y", ""});
  EXPECT_EQ(drafts.find("7")->text, "y");
}

TEST(Drafts, AreNotKeptWithoutAFolder) {
  Drafts drafts("");
  drafts.keep({"a.vcad", "text", ""});
  EXPECT_FALSE(drafts.find("a.vcad"));
  EXPECT_TRUE(drafts.list().empty());
}

TEST(StateFolder, FollowsFromTheFolder) {
  const TestFolder folder;
  std::filesystem::create_directories(folder.path / "a");
  const uint16_t port = usual_port(folder.path / "a");
  EXPECT_GE(port, 20000);
  EXPECT_LT(port, 30000);
  EXPECT_EQ(usual_port(folder.path / "a/../a"), port);
  EXPECT_NE(state_folder(folder.path / "a"), state_folder(folder.path));
}

TEST(StateFolder, IsLockedByOneStudio) {
  const TestFolder folder;
  {
    const StateLock first(folder.path / "state"), second(folder.path / "state");
    EXPECT_TRUE(first.is_held());
    EXPECT_FALSE(second.is_held());
  }
  EXPECT_TRUE(StateLock(folder.path / "state").is_held());
  EXPECT_FALSE(StateLock("").is_held());
  folder.write("file", "");
  EXPECT_FALSE(StateLock(folder.path / "file").is_held());
}

}  // namespace
}  // namespace ombre::studio
