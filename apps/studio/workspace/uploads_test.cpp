#include "studio/workspace/uploads.h"

#include <gtest/gtest.h>

#include "studio/workspace/studio_messages.h"
#include "studio/workspace/test_folder.h"

namespace ombre::studio {
namespace {

size_t files_in(const TestFolder& folder) {
  return static_cast<size_t>(std::distance(std::filesystem::recursive_directory_iterator(folder.path), {}));
}

TEST(Uploads, PutPiecesTogether) {
  const TestFolder folder;
  const Workspace workspace(folder.path);
  Uploads uploads(workspace);
  uploads.take({"a1", "models/part.stl", 0, "solid "});
  uploads.take({"b2", "other.obj", 0, "v 0 0 0", true});
  EXPECT_FALSE(std::filesystem::exists(folder.path / "models/part.stl"));
  uploads.take({"a1", "models/part.stl", 6, "part", true});
  EXPECT_EQ(folder.read("models/part.stl"), "solid part");
  EXPECT_EQ(folder.read("other.obj"), "v 0 0 0");
  EXPECT_EQ(files_in(folder), 3U);  // the folder and the two files
}

TEST(Uploads, OverwriteOnlyOnRequest) {
  const TestFolder folder;
  folder.write("part.stl", "mine");
  const Workspace workspace(folder.path);
  Uploads uploads(workspace);
  EXPECT_EQ(code_of([&] { uploads.take({"a", "part.stl", 0, "theirs", true}); }), "exists");
  EXPECT_EQ(folder.read("part.stl"), "mine");
  uploads.take({"a", "part.stl", 0, "theirs", true, true});
  EXPECT_EQ(folder.read("part.stl"), "theirs");
}

TEST(Uploads, RefuseOtherPlacesAndOrders) {
  const TestFolder folder;
  const Workspace workspace(folder.path);
  Uploads uploads(workspace);
  EXPECT_EQ(code_of([&] { uploads.take({"a", "../part.stl", 0, "x", true}); }), "name");
  EXPECT_EQ(code_of([&] { uploads.take({"a", "/etc/part.stl", 0, "x", true}); }), "name");
  EXPECT_EQ(code_of([&] { uploads.take({"a", ".ssh/part.stl", 0, "x", true}); }), "name");
  EXPECT_EQ(code_of([&] { uploads.take({"../a", "part.stl", 0, "x", true}); }), "request");
  EXPECT_EQ(code_of([&] { uploads.take({"a", "part.stl", 5, "x", true}); }), "request");
  uploads.take({"a", "part.stl", 0, "x"});
  EXPECT_EQ(code_of([&] {
              uploads.take({"a", "part.stl", 0, "y"}), uploads.take({"a", "part.stl", 2, "z"});
            }),
            "request");
}

TEST(Uploads, LeaveNothingOfUnfinishedFiles) {
  const TestFolder folder;
  {
    const Workspace workspace(folder.path);
    Uploads uploads(workspace);
    uploads.take({"a", "part.stl", 0, "begun"});
  }
  EXPECT_EQ(files_in(folder), 0U);
}

}  // namespace
}  // namespace ombre::studio
