#include "stores/archive_store.h"

#include "formats/containers/zip_archive.h"
#include "stores/memory_store.h"
#include "stores/test_piece_job.h"

namespace ombre::stores {
namespace {

constexpr int64_t packed_count = 9;

FolderContents unpacked(const std::string& path) {
  const std::string bytes = formats::read_file(path);
  Diagnostics diagnostics;
  formats::ZipReader reader(path, bytes, diagnostics);
  FolderContents all;
  for (const std::string& name : reader.names()) all[name] = reader.read(name);
  return all;
}

class ArchiveStoreTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!formats::can_write_zip()) GTEST_SKIP() << "this build has no libzip";
  }

  TemporaryFolder root_;
  const std::string path_ = root_.file("job.zip");
  const PieceJob job_{packed_count};
};

}  // namespace

TEST_F(ArchiveStoreTest, HoldsWhatTheFolderHolds) {
  FolderStore folder(root_.file("job"), job_, FolderUse::fresh);
  put_pieces(folder, 0, packed_count);
  folder.close();
  ArchiveStore archive(path_, job_, FolderUse::fresh);
  put_pieces(archive, 0, packed_count);
  EXPECT_FALSE(std::filesystem::exists(path_));
  archive.close();
  EXPECT_EQ(unpacked(path_), contents_of(root_.file("job")));
  EXPECT_EQ(archive.finished(), folder.finished());
  EXPECT_FALSE(std::filesystem::exists(path_ + ".pieces"));
  EXPECT_FALSE(std::filesystem::exists(path_ + ".part"));
}

TEST_F(ArchiveStoreTest, StoppedJobsResumeToTheSameBytes) {
  ArchiveStore whole(root_.file("whole.zip"), job_, FolderUse::fresh);
  put_pieces(whole, 0, packed_count);
  whole.close();
  {
    ArchiveStore stopped(path_, job_, FolderUse::fresh);
    put_pieces(stopped, 0, 4);
    stopped.close();
  }
  EXPECT_FALSE(std::filesystem::exists(path_));
  ArchiveStore resumed(path_, job_, FolderUse::resume);
  EXPECT_EQ(resumed.finished().size(), 4U);
  put_pieces(resumed, 4, packed_count);
  resumed.close();
  EXPECT_EQ(formats::read_file(path_), formats::read_file(root_.file("whole.zip")));
}

TEST_F(ArchiveStoreTest, ReplacesAnArchiveOnlyIfItMay) {
  write_text(path_, "mine");
  expect_error([&] { ArchiveStore(path_, job_, FolderUse::fresh); }, "job.zip exists already");
  ArchiveStore archive(path_, job_, FolderUse::replace);
  put_pieces(archive, 0, packed_count);
  EXPECT_EQ(formats::read_file(path_), "mine");
  archive.close();
  EXPECT_EQ(unpacked(path_).size(), 2U + 7);  // pieces 0 and 5 have no files
}

TEST(MemoryStore, KeepsPieces) {
  MemoryStore store;
  put_pieces(store, 0, 3);
  Piece other = piece(1);
  other.record = {{"again", true}};
  store.put(other);
  store.close();
  EXPECT_EQ(store.finished().size(), 3U);
  EXPECT_EQ(store.finished().at(1), entry_of(other));
  EXPECT_EQ(store.pieces().at(2).files, piece(2).files);
}

}  // namespace ombre::stores
