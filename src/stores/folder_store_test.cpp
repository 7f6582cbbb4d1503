#include "stores/folder_store.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "base/system/test_progress.h"
#include "stores/test_piece_job.h"

namespace ombre::stores {
namespace {

constexpr int64_t piece_count = 12;

class FolderStoreTest : public testing::Test {
 protected:
  std::string folder(const std::string& name = "job") const { return root_.file(name); }
  std::string in_folder(const std::string& name) const { return folder() + "/" + name; }

  void run(FolderUse use, const PieceJob& job) {
    FolderStore store(folder(), job, use);
    for (int64_t id = 0; id < piece_count; ++id)
      if (!store.finished().contains(id)) store.put(piece(id));
    store.close();
  }
  // Returns the files of an uninterrupted run.
  FolderContents whole() {
    run(FolderUse::replace, job_);
    return contents_of(folder());
  }
  Entries finished_on_resume() { return FolderStore(folder(), job_, FolderUse::resume).finished(); }

  TemporaryFolder root_;
  const PieceJob job_{piece_count};
};

}  // namespace

TEST_F(FolderStoreTest, HoldsTheDescriptionTheJournalAndTheFiles) {
  const FolderContents there = whole();
  EXPECT_EQ(there.size(), 2U + 9);  // pieces 0, 5 and 10 have no files
  Entries entries;
  for (int64_t id = 0; id < piece_count; ++id) entries[id] = entry_of(piece(id));
  EXPECT_EQ(there.at("journal.jsonl"), to_lines("piece", entries));
  EXPECT_EQ(there.at("text.json"), job_.description(entries));
  EXPECT_EQ(there.at("piece_3.txt"), piece(3).files[0].second);
}

TEST_F(FolderStoreTest, TheJournalIsSortedWhenItEnds) {
  const FolderContents expected = whole();
  FolderStore store(folder(), job_, FolderUse::replace);
  for (int64_t id = piece_count; id-- > 0;) store.put(piece(id));
  EXPECT_NE(contents_of(folder()).at("journal.jsonl"), expected.at("journal.jsonl"));
  store.close();
  EXPECT_EQ(contents_of(folder()), expected);
}

TEST_F(FolderStoreTest, JournalsTornAtAnyByteResumeToTheSameBytes) {
  const PieceJob job(3);
  const auto finish = [&](FolderUse use) {
    FolderStore store(folder(), job, use);
    const auto known = static_cast<int64_t>(store.finished().size());
    put_pieces(store, known, 3);
    store.close();
    return known;
  };
  finish(FolderUse::fresh);
  const FolderContents expected = contents_of(folder());
  const std::string journal = expected.at("journal.jsonl");
  for (size_t length = 0; length < journal.size(); ++length) {
    const std::string torn = journal.substr(0, length);
    write_text(in_folder("journal.jsonl"), torn);
    write_text(in_folder("piece_2.txt.part"), "half");
    EXPECT_EQ(finish(FolderUse::resume), std::ranges::count(torn, '\n')) << length;
    ASSERT_EQ(contents_of(folder()), expected) << length;
  }
}

TEST_F(FolderStoreTest, PiecesWithOtherFilesThanTheJournalStatesAreNotFinished) {
  const FolderContents expected = whole();
  std::string changed = expected.at("piece_3.txt");
  changed[2] = static_cast<char>(changed[2] + 1);
  write_text(in_folder("piece_3.txt"), changed);
  std::filesystem::remove(in_folder("piece_4.txt"));
  write_text(in_folder("piece_6.txt"), expected.at("piece_6.txt") + "x");
  const Entries finished = finished_on_resume();
  EXPECT_EQ(finished.size(), static_cast<size_t>(piece_count - 3));
  for (const int64_t id : {3, 4, 6}) EXPECT_FALSE(finished.contains(id)) << id;
  run(FolderUse::resume, job_);
  EXPECT_EQ(contents_of(folder()), expected);
}

TEST_F(FolderStoreTest, ReadingFinishedPiecesTellsHowFarItIsAndStops) {
  CheckRecorder recorder;
  const FolderContents expected = whole();
  uint64_t bytes = 0;
  for (const auto& [name, text] : expected)
    if (name.ends_with(".txt")) bytes += text.size();
  FolderStore(folder(), job_, FolderUse::resume, {2, &recorder, nullptr});
  EXPECT_EQ(recorder.seen.size(), static_cast<size_t>(piece_count));
  uint64_t most = 0;
  for (const HowFar& how_far : recorder.seen) {
    EXPECT_EQ(how_far.total, bytes);
    most = std::max(most, how_far.done);
  }
  EXPECT_EQ(most, bytes);
  StopFlag stop;
  stop.request();
  EXPECT_THROW(FolderStore(folder(), job_, FolderUse::resume, {2, nullptr, &stop}), Cancelled);
  EXPECT_EQ(contents_of(folder()), expected);
}

TEST_F(FolderStoreTest, UsedFoldersAreRefused) {
  const FolderContents expected = whole();
  expect_error([&] { run(FolderUse::fresh, job_); }, "already holds a text job; continue it with --resume");
  expect_error([&] { run(FolderUse::resume, PieceJob(piece_count, "b")); }, "holds another design");
  write_text(in_folder("text.json"), "{");
  expect_error([&] { run(FolderUse::resume, job_); }, "text.json is damaged");
  run(FolderUse::replace, job_);
  EXPECT_EQ(contents_of(folder()), expected);
  write_text(in_folder("text.json"), R"({"format": "of another program"})");
  expect_error([&] { run(FolderUse::replace, job_); }, "was not written by Ombre");
  write_text(root_.file("file"), "");
  expect_error([&] { FolderStore(root_.file("file"), job_, FolderUse::fresh); }, "is a file, and the pieces need a");
}

TEST_F(FolderStoreTest, FilesOfOthersStay) {
  std::filesystem::create_directory(folder());
  write_text(in_folder("thesis.tex"), "years of work");
  for (const FolderUse use : {FolderUse::fresh, FolderUse::resume})
    expect_error([&] { run(use, job_); }, "it holds for example thesis.tex");
  run(FolderUse::replace, job_);
  write_text(in_folder("piece_99.txt"), "of no piece");
  run(FolderUse::replace, PieceJob(piece_count, "b"));
  EXPECT_EQ(contents_of(folder()).at("thesis.tex"), "years of work");
  EXPECT_EQ(contents_of(folder()).at("piece_99.txt"), "of no piece");
  expect_error([&] { run(FolderUse::replace, PieceJob(100)); }, "piece_99.txt is not part of a text job");
  EXPECT_TRUE(contents_of(folder()).contains("piece_3.txt"));
}

TEST_F(FolderStoreTest, ReplacingLeavesNoPieceOfTheOldJob) {
  run(FolderUse::replace, job_);
  write_text(in_folder("journal-1-of-2.jsonl"), "of a share of the job");
  write_text(in_folder("text.json.part"), "{");
  FolderStore(folder(), PieceJob(2), FolderUse::replace).close();
  EXPECT_EQ(contents_of(folder()), (FolderContents{{"text.json", PieceJob(2).description({})}, {"journal.jsonl", ""}}));
}

TEST_F(FolderStoreTest, OneProcessHasTheFolder) {
  const FolderStore store(folder(), job_, FolderUse::fresh);
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      FolderStore(folder(), job_, FolderUse::resume);
    } catch (const Error& error) {
      ::_exit(std::string(error.what()).find("another run is writing") == std::string::npos ? 2 : 0);
    }
    ::_exit(1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST_F(FolderStoreTest, AKilledProcessLeavesItsPiecesAndNoLock) {
  const FolderContents expected = whole();
  for (int64_t killed_after = 0; killed_after < piece_count; killed_after += 3) {
    const pid_t child = ::fork();
    if (child == 0) {
      FolderStore store(folder(), job_, FolderUse::replace, {1});  // a forked process has no threads of its parent
      put_pieces(store, 0, killed_after);
      ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(finished_on_resume().size(), static_cast<size_t>(killed_after));
    run(FolderUse::resume, job_);
    EXPECT_EQ(contents_of(folder()), expected);
  }
}

}  // namespace ombre::stores
