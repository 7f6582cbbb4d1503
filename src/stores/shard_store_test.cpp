#include "stores/shard_store.h"

#include <sys/wait.h>
#include <unistd.h>

#include "stores/folder_store.h"
#include "stores/gather.h"
#include "stores/test_piece_job.h"

namespace ombre::stores {
namespace {

constexpr int64_t shared_count = 40;

class ShardStoreTest : public testing::Test {
 protected:
  std::string folder() const { return root_.file("job"); }

  // Does some pieces as a share of the job.
  void run(const Shard& shard, int64_t begin, int64_t end) const {
    ShardStore store(folder(), job_, shard);
    for (int64_t id = begin; id < end; ++id)
      if (!store.finished().contains(id)) store.put(piece(id));
    store.close();
  }
  Gathered gathered() const { return gather(folder(), job_, {0, shared_count}); }

  TemporaryFolder root_;
  const PieceJob job_{shared_count};
};

}  // namespace

TEST(Shard, KnowsTheNamesOfItsFiles) {
  const Shard shard{3, 40};
  EXPECT_EQ(shard.journal(), "journal-3-of-40.jsonl");
  for (const std::string& name : {shard.journal(), shard.lock(), shard.description()}) EXPECT_TRUE(is_of_shard(name));
  EXPECT_TRUE(is_journal_of_shard(shard.journal()));
  EXPECT_FALSE(is_journal_of_shard(shard.lock()));
  for (const char* name : {"journal.jsonl", "journal-0-of-2.jsonl", "journal-3-of-2.jsonl", "journal-03-of-4.jsonl",
                           "journal-of-.jsonl", "journal-1-of-.jsonl", "journal1-of-2.jsonl", "journal-1-of-2x.jsonl",
                           "my-journal-1-of-2.jsonl", "journal-1-of-2.json", "", "-of-", "journal.lock"})
    EXPECT_FALSE(is_of_shard(name)) << name;
}

TEST_F(ShardStoreTest, ProcessesShareAFolder) {
  constexpr int processes = 4;
  constexpr int64_t each = shared_count / processes;
  std::vector<pid_t> children;
  for (int n = 0; n < processes; ++n) {
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        run({n + 1, processes}, n * each, (n + 1) * each);
      } catch (const std::exception&) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  const Gathered all = gathered();
  EXPECT_TRUE(all.gaps.empty());
  EXPECT_TRUE(all.repeated.empty());
  EXPECT_TRUE(job_.is_complete(all.finished));

  // But for the journals, the folder is that of one process.
  FolderStore alone(root_.file("alone"), job_, FolderUse::fresh);
  put_pieces(alone, 0, shared_count);
  EXPECT_EQ(all.finished, alone.finished());
  FolderContents expected = contents_of(root_.file("alone")), there = contents_of(folder());
  expected.erase("journal.jsonl");
  std::string lines;
  for (int n = 0; n < processes; ++n) {
    lines += there.at(Shard{n + 1, processes}.journal());
    there.erase(Shard{n + 1, processes}.journal());
  }
  EXPECT_EQ(there, expected);
  EXPECT_EQ(lines, to_lines("piece", alone.finished()));
}

TEST_F(ShardStoreTest, AShareResumesFromItsOwnJournal) {
  run({1, 2}, 0, 3);
  run({2, 2}, 20, 30);
  std::filesystem::remove(folder() + "/piece_21.txt");
  EXPECT_EQ(ShardStore(folder(), job_, {1, 2}).finished().size(), 3U);
  EXPECT_EQ(ShardStore(folder(), job_, {2, 2}).finished().size(), 9U);
}

TEST_F(ShardStoreTest, TwoProcessesDoNotDoOneShare) {
  const ShardStore store(folder(), job_, {1, 2});
  expect_error([&] { run({1, 2}, 0, 1); }, "does the same share of the job");
  run({2, 2}, 0, 1);
}

TEST_F(ShardStoreTest, AFolderIsSharedOrUsedAlone) {
  {
    const ShardStore store(folder(), job_, {1, 2});
    expect_error([&] { FolderStore(folder(), job_, FolderUse::resume); }, "another run is writing");
  }
  const FolderStore alone(folder(), job_, FolderUse::resume);
  expect_error([&] { run({1, 2}, 0, 1); }, "another run is writing");
}

TEST_F(ShardStoreTest, AResumedRunTakesOverWhatSharesHaveDone) {
  run({1, 2}, 0, 20);
  run({2, 2}, 20, 38);
  std::filesystem::remove(folder() + "/piece_3.txt");
  {
    FolderStore whole(folder(), job_, FolderUse::resume);
    EXPECT_EQ(whole.finished().size(), 37U);
    for (const int64_t id : {3, 38, 39}) whole.put(piece(id));
    whole.close();
  }
  FolderStore alone(root_.file("alone"), job_, FolderUse::fresh);
  put_pieces(alone, 0, shared_count);
  alone.close();
  EXPECT_EQ(contents_of(folder()), contents_of(root_.file("alone")));
}

TEST_F(ShardStoreTest, OtherJobsAndForeignFilesAreRefused) {
  run({1, 2}, 0, 1);
  expect_error([&] { ShardStore(folder(), PieceJob(shared_count, "b"), {2, 2}); }, "holds another design");
  std::filesystem::remove(folder() + "/text.json");
  write_text(folder() + "/thesis.tex", "");
  expect_error([&] { run({2, 2}, 0, 1); }, "it holds for example thesis.tex");
}

TEST_F(ShardStoreTest, GatheringNamesGapsAndRepeatedPieces) {
  run({1, 3}, 2, 8);
  run({2, 3}, 7, 12);
  run({3, 3}, 14, 15);
  std::filesystem::remove(folder() + "/piece_9.txt");
  const Gathered some = gathered();
  EXPECT_EQ(some.gaps, (std::vector<PieceRange>{{0, 2}, {9, 10}, {12, 14}, {15, shared_count}}));
  EXPECT_EQ(some.repeated, (std::vector<Repeated>{{7, {"journal-1-of-3.jsonl", "journal-2-of-3.jsonl"}}}));
  EXPECT_EQ(some.finished.size(), 10U);  // 2 to 8, 10, 11 and 14
  EXPECT_EQ(gather(folder(), job_, {3, 9}).gaps, std::vector<PieceRange>{});
  expect_error([&] { gather(folder(), PieceJob(shared_count, "b"), {0, 1}); }, "holds another design");
}

}  // namespace ombre::stores
