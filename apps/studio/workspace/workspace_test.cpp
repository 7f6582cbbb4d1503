#include "studio/workspace/workspace.h"

#include <gtest/gtest.h>

#include "studio/workspace/studio_messages.h"
#include "studio/workspace/test_folder.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

TEST(Workspace, ListsDesignsAndLeavesOutWhatIsHiddenOrAJob) {
  const TestFolder folder;
  for (const char* name : {"b.vcad", "a.scad", "parts/c.vcad", ".hidden/d.vcad", "notes.txt", "b_slices/job.json"})
    folder.write(name, "x");
  EXPECT_EQ(Workspace(folder.path).list(), (std::vector<std::string>{"a.scad", "b.vcad", "parts/c.vcad"}));
}

TEST(Workspace, ListsDataBesideDesigns) {
  const TestFolder folder;
  for (const char* name : {"a.vcad", "head.nii.gz", "seat.VTU", "deep/history.csv", "scan/1.dcm", "scan/2.dcm",
                           "slices/job.json", "slices/b.csv", ".hidden/c.csv"})
    folder.write(name, "x");
  std::vector<std::string> found;
  for (const Workspace::DataFile& file : Workspace(folder.path).list_data())
    found.push_back(file.name + " " + std::string(name_of(file.kind)));
  EXPECT_EQ(found,
            (std::vector<std::string>{"deep/history.csv table", "head.nii.gz scan", "scan scan", "seat.VTU results"}));
}

TEST(Workspace, RefusesNamesThatLeadOut) {
  const TestFolder folder;
  folder.write("inside/a.vcad", "x");
  folder.write("secret.vcad", "secret");
  fs::create_directory_symlink(folder.path, folder.path / "inside/link");
  fs::create_symlink(folder.path / "secret.vcad", folder.path / "inside/file.vcad");
  Workspace workspace(folder.path / "inside");
  for (const char* name :
       {"../secret.vcad", "/etc/passwd", "a/../../secret.vcad", "link/secret.vcad", "file.vcad", "", ".", "..",
        "./a.vcad", ".env", "b/.git/x", "a//b.vcad", "a\\b.vcad", "a\nb.vcad", "../inside/a.vcad"}) {
    EXPECT_THROW(workspace.read(name), RequestError) << name;
    EXPECT_THROW(workspace.save(name, "x", ""), RequestError) << name;
  }
  EXPECT_EQ(workspace.read("a.vcad").text, "x");
  EXPECT_EQ(folder.read("secret.vcad"), "secret");
}

class WorkspaceOfOneFile : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("a.vcad", "one");
    version = workspace.read("a.vcad").version;
  }

  const TestFolder folder;
  Workspace workspace{folder.path};
  std::string version;  // that of the file
};

TEST_F(WorkspaceOfOneFile, SavesWhatItHasSeenAlone) {
  const auto second = workspace.save("a.vcad", "two", version);
  ASSERT_TRUE(std::holds_alternative<std::string>(second));
  EXPECT_EQ(folder.read("a.vcad"), "two");

  folder.write("a.vcad", "of another program");
  const auto refused = workspace.save("a.vcad", "three", std::get<std::string>(second));
  ASSERT_TRUE(std::holds_alternative<SaveConflict>(refused));
  EXPECT_EQ(std::get<SaveConflict>(refused).disk->text, "of another program");
  EXPECT_EQ(folder.read("a.vcad"), "of another program");

  fs::remove(folder.path / "a.vcad");
  const auto gone = workspace.save("a.vcad", "three", std::get<std::string>(second));
  ASSERT_TRUE(std::holds_alternative<SaveConflict>(gone));
  EXPECT_FALSE(std::get<SaveConflict>(gone).disk);
  EXPECT_TRUE(std::holds_alternative<std::string>(workspace.save("a.vcad", "three", "")));
}

// The device /dev/full refuses all writes, like a full disk.
TEST_F(WorkspaceOfOneFile, KeepsTheOldFileWhereTheDiskIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP();
  fs::create_symlink("/dev/full", folder.path / "a.vcad.part");
  try {
    workspace.save("a.vcad", "two", version);
    FAIL() << "it was saved";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("No space left on device"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("a.vcad"), std::string::npos) << error.what();
  }
  EXPECT_EQ(folder.read("a.vcad"), "one");
  EXPECT_FALSE(fs::exists(fs::symlink_status(folder.path / "a.vcad.part")));
  EXPECT_TRUE(workspace.changes().empty());
  // Now there is space: the same text can be saved over the same version.
  ASSERT_TRUE(std::holds_alternative<std::string>(workspace.save("a.vcad", "two", version)));
  EXPECT_EQ(folder.read("a.vcad"), "two");
}

TEST_F(WorkspaceOfOneFile, NoticesChangesByOthers) {
  EXPECT_TRUE(workspace.changes().empty());
  ASSERT_TRUE(std::holds_alternative<std::string>(workspace.save("a.vcad", "two", version)));
  EXPECT_TRUE(workspace.changes().empty());  // its own changes do not count

  folder.write("a.vcad", "three!");
  const auto changes = workspace.changes();
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].version, workspace.read("a.vcad").version);
  EXPECT_TRUE(workspace.changes().empty());

  fs::remove(folder.path / "a.vcad");
  ASSERT_EQ(workspace.changes().size(), 1U);
  EXPECT_TRUE(workspace.changes().empty());
}

TEST(Workspace, SaysWhatIsNoText) {
  const TestFolder folder;
  folder.write("a.vcad", "\xff\xfe");
  folder.write("b.vcad", std::string("a\0b", 3));
  Workspace workspace(folder.path);
  EXPECT_THROW(workspace.read("a.vcad"), RequestError);
  EXPECT_THROW(workspace.read("b.vcad"), RequestError);
  EXPECT_THROW(workspace.save("a.png", "x", ""), RequestError);
}

}  // namespace
}  // namespace ombre::studio
