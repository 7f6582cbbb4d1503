#include "studio/workspace/file_actions.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "studio/workspace/studio_messages.h"
#include "studio/workspace/test_folder.h"

namespace ombre::studio {
namespace {

class FileActions : public testing::Test {
 protected:
  bool has(const std::string& name) const { return std::filesystem::exists(folder.path / name); }
  TestFolder folder;
  Workspace workspace{folder.path};
};

TEST_F(FileActions, RenameAndDuplicateWithPresets) {
  const std::string presets = R"({"parameterSets": {"small": {"r": "1"}}, "fileFormatVersion": "1"})";
  folder.write("a.vcad", "text");
  folder.write("a.presets.json", presets);
  rename_file(workspace, "a.vcad", "parts/b.vcad");
  EXPECT_FALSE(has("a.vcad") || has("a.presets.json"));
  EXPECT_EQ(folder.read("parts/b.vcad") + folder.read("parts/b.presets.json"), "text" + presets);
  duplicate_file(workspace, "parts/b.vcad", "c.vcad");
  EXPECT_EQ(folder.read("c.vcad") + folder.read("c.presets.json"), "text" + presets);
  EXPECT_TRUE(has("parts/b.vcad") && has("parts/b.presets.json"));
}

TEST_F(FileActions, NeverOverwrite) {
  folder.write("a.vcad", "a");
  folder.write("b.vcad", "b");
  EXPECT_EQ(code_of([&] { rename_file(workspace, "a.vcad", "b.vcad"); }), "exists");
  EXPECT_EQ(code_of([&] { duplicate_file(workspace, "a.vcad", "b.vcad"); }), "exists");
  EXPECT_EQ(code_of([&] { make_folder(workspace, "b.vcad"); }), "exists");
  EXPECT_EQ(code_of([&] { rename_file(workspace, "none.vcad", "c.vcad"); }), "gone");
  EXPECT_EQ(code_of([&] { rename_file(workspace, "a.vcad", "../c.vcad"); }), "name");
  EXPECT_EQ(code_of([&] { rename_file(workspace, "a.vcad", "c.png"); }), "name");
  EXPECT_EQ(folder.read("a.vcad") + folder.read("b.vcad"), "ab");
}

TEST_F(FileActions, DeleteIntoTheTrash) {
  for (const char* text : {"one", "two"}) {
    folder.write("a.vcad", text);
    const std::string place = delete_file(workspace, "a.vcad");
    EXPECT_FALSE(has("a.vcad"));
    EXPECT_EQ(folder.read(std::filesystem::path(place).lexically_relative(folder.path).string()), text);
  }
  EXPECT_EQ(code_of([&] { delete_file(workspace, "a.vcad"); }), "gone");
  EXPECT_EQ(code_of([&] { delete_file(workspace, ".ombre-trash"); }), "name");
  EXPECT_TRUE(workspace.list().empty());
}

TEST_F(FileActions, MakeFolders) {
  make_folder(workspace, "parts/small");
  EXPECT_TRUE(std::filesystem::is_directory(folder.path / "parts/small"));
}

TEST_F(FileActions, TouchNoPipes) {
  ASSERT_EQ(::mkfifo((folder.path / "pipe.vcad").c_str(), 0600), 0);
  EXPECT_EQ(code_of([&] { duplicate_file(workspace, "pipe.vcad", "b.vcad"); }), "gone");
  EXPECT_EQ(code_of([&] { (void)workspace.read("pipe.vcad"); }), "name");
  EXPECT_EQ(code_of([&] { (void)workspace.save("pipe.vcad", "text", ""); }), "name");
}

}  // namespace
}  // namespace ombre::studio
