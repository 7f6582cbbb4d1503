#include "studio/workspace/downloads.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/text/error.h"
#include "formats/containers/zip_archive.h"
#include "studio/workspace/studio_messages.h"
#include "studio/workspace/test_folder.h"

namespace ombre::studio {
namespace {

TEST(Downloads, HaveKeysThatWorkOnce) {
  Downloads downloads;
  const std::string key = downloads.add({"/a"});
  EXPECT_EQ(key.size(), 32U);
  EXPECT_FALSE(downloads.take("0"));
  EXPECT_EQ(downloads.take(key)->path, "/a");
  EXPECT_FALSE(downloads.take(key));
  const std::string oldest = downloads.add({"/b"});
  for (size_t n = 0; n < Downloads::most; ++n) downloads.add({"/c"});
  EXPECT_FALSE(downloads.take(oldest));
}

TEST(Downloads, PackFolders) {
  if (!formats::can_write_zip()) GTEST_SKIP();
  const TestFolder folder;
  const std::string large(3 << 20, 'x');
  folder.write("job/slice_0.png", "first");
  folder.write("job/deep/large.txt", large);
  folder.write("job/.hidden", "secret");
  folder.write("job/empty.txt", "");
  folder.write("outside.txt", "outside");
  std::filesystem::create_symlink(folder.path / "outside.txt", folder.path / "job/link.txt");
  ASSERT_EQ(::mkfifo((folder.path / "job/pipe").c_str(), 0600), 0);
  double share = 0;
  zip_folder((folder.path / "job").string(), (folder.path / "job.zip").string(), [&](double now) {
    EXPECT_GE(now, share);
    share = now;
  });
  EXPECT_NEAR(share, 1, 1e-9);
  const std::string bytes = folder.read("job.zip"), name = "job.zip";
  Diagnostics diagnostics;
  formats::ZipReader zip(name, bytes, diagnostics, {.entries = 100'000});
  EXPECT_EQ(zip.names(), (std::vector<std::string>{"job/deep/large.txt", "job/empty.txt", "job/slice_0.png"}));
  EXPECT_EQ(zip.read("job/slice_0.png"), "first");
  EXPECT_EQ(zip.read("job/deep/large.txt"), large);
}

TEST(Downloads, StopPackingWhenTheyAreCancelled) {
  if (!formats::can_write_zip()) GTEST_SKIP();
  const TestFolder folder;
  folder.write("job/a.txt", "text");
  int calls = 0;
  const auto report = [&](double) {
    if (++calls == 2) throw Cancelled();
  };
  EXPECT_THROW(zip_folder((folder.path / "job").string(), (folder.path / "job.zip").string(), report), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "job.zip"));
  std::filesystem::create_directories(folder.path / "none");
  EXPECT_THROW(zip_folder((folder.path / "none").string(), (folder.path / "job.zip").string(), report), RequestError);
}

}  // namespace
}  // namespace ombre::studio
