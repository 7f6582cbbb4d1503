#include "jobs/slice/stored_stages.h"
#include "jobs/test_slices.h"

#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <random>
#include <thread>

#include "base/system/not_copied.h"
#include "base/system/test_progress.h"

namespace ombre::compile {
namespace {

// A small disk that is mounted on a folder, if this is allowed.
class SmallDisk : NotCopied {
 public:
  explicit SmallDisk(const std::string& folder)
      : folder_(folder), mounted_(::mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=80k") == 0) {}
  ~SmallDisk() {
    if (mounted_) ::umount(folder_.c_str());
  }

  bool is_mounted() const { return mounted_; }
  bool grow() const { return ::mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT, "size=10m") == 0; }

 private:
  std::string folder_;
  bool mounted_;
};

// Returns a producer that asks to stop once `after` slabs have begun.
LayerProducer stopping(const LayerProducer& producer, StopFlag& stop, int after) {
  auto begun = std::make_shared<std::atomic<int>>(0);
  return [=, &stop](int64_t begin, int64_t end, const StopFlag*) {
    if (++*begun > after) stop.request();
    return producer(begin, end, nullptr);
  };
}

}  // namespace

TEST_F(Slice, StoppedRunsResumeToTheSameBytes) {
  const Contents reference = expected(ball_request(), root_);
  for (const int after : {0, 1, 2, 3}) {
    StopFlag stop;
    const SliceRequest request = ball_request();
    EXPECT_THROW(slice(request, stopping(ball(request), stop, after), options(FolderUse::replace, 1), nullptr, &stop),
                 Cancelled);
    const Contents partial = contents(folder());
    EXPECT_LT(partial.size(), reference.size());
    for (const auto& [name, text] : partial) {
      if (name.ends_with(".png")) {
        EXPECT_TRUE(text == reference.at(name)) << name;
      }
    }
    EXPECT_EQ(*job_json(folder()).find("status")->string(), "unfinished");
    const SliceReport report = run(request, options(FolderUse::resume));
    EXPECT_EQ(report.layers_kept, 8 * after);
    expect_same(reference, contents(folder()));
  }
}

TEST_F(Slice, StagesStayUntilTheJobIsComplete) {
  const Hash key = hash_bytes("what the values are made from");
  const auto stages = [&](FolderUse use) { return StoredStages(folder(), use, {}); };
  stages(FolderUse::fresh).keep(key, "values");
  EXPECT_EQ(stages(FolderUse::resume).find(key), "values");
  EXPECT_EQ(stages(FolderUse::resume).find(hash_bytes("something else")), std::nullopt);
  write(fs::path(folder()) / "stages/0.stage", "damage");
  EXPECT_EQ(stages(FolderUse::resume).find(key), std::nullopt);
  stages(FolderUse::resume).keep(key, "again");
  EXPECT_EQ(stages(FolderUse::replace).find(key), std::nullopt);
  stages(FolderUse::resume).remove();
  EXPECT_FALSE(fs::exists(fs::path(folder()) / "stages"));
}

TEST_F(Slice, StagesLeaveFilesOfOthersAlone) {
  const fs::path theirs = fs::path(folder()) / "stages/notes.txt";
  fs::create_directories(theirs.parent_path());
  write(theirs, "mine");
  StoredStages(folder(), FolderUse::replace, {}).remove();
  StoredStages stages(folder(), FolderUse::replace, {});
  stages.keep(hash_bytes("a"), "values");
  stages.remove();
  EXPECT_EQ(contents(theirs.parent_path()), (Contents{{"notes.txt", "mine"}}));
}

TEST_F(Slice, StopsWhileASlabIsMade) {
  const SliceRequest request = ball_request();
  StopFlag stop;
  const LayerProducer cancelling = [&](int64_t begin, int64_t end, const StopFlag* given) {
    EXPECT_EQ(given, &stop);
    if (begin == 16) {
      stop.request();
      throw Cancelled();
    }
    return ball(request)(begin, end, given);
  };
  EXPECT_THROW(slice(request, cancelling, options(FolderUse::fresh, 1), nullptr, &stop), Cancelled);
  EXPECT_EQ(contents(folder()).size(), 16U + 2);
  expect_same(expected(request, root_), (run(request, options(FolderUse::resume)), contents(folder())));
}

TEST_F(Slice, StopsWhileFinishedLayersAreRead) {
  run(ball_request(), options());
  const Contents whole = contents(folder());
  StopFlag stop;
  stop.request();
  const SliceRequest request = ball_request();
  EXPECT_THROW(slice(request, ball(request), options(FolderUse::resume), nullptr, &stop), Cancelled);
  expect_same(whole, contents(folder()));
}

TEST_F(Slice, TellsHowFarReadingFinishedLayersIs) {
  CheckRecorder recorder;
  run(ball_request(), options());
  uint64_t bytes = 0;
  for (const auto& [name, text] : contents(folder()))
    if (name.ends_with(".png")) bytes += text.size();
  const SliceRequest request = ball_request();
  slice(request, ball(request), options(FolderUse::resume), &recorder);
  EXPECT_EQ(recorder.seen.size(), 40u);  // layers
  for (const HowFar& how_far : recorder.seen) EXPECT_EQ(how_far.total, bytes);
  const auto less = [](const HowFar& a, const HowFar& b) { return a.done < b.done; };
  EXPECT_EQ(std::ranges::max_element(recorder.seen, less)->done, bytes);
}

TEST_F(Slice, KilledRunsResumeToTheSameBytes) {
  std::mt19937 random(7);
  for (const SliceRequest& request : {ball_request(), mask_request()}) {
    const Contents reference = expected(request, root_);
    for (int round = 0; round < 12; ++round) {
      const pid_t child = ::fork();
      if (child == 0) {
        try {
          const LayerProducer slow = [producer = ball(request)](int64_t begin, int64_t end, const StopFlag*) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            return producer(begin, end, nullptr);
          };
          slice(request, slow, options(round % 2 ? FolderUse::resume : FolderUse::replace, 1));
        } catch (...) {
          ::_exit(1);
        }
        ::_exit(0);
      }
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 18000));
      ::kill(child, SIGKILL);
      int status = 0;
      ::waitpid(child, &status, 0);
      if (round % 2) continue;  // then the next run resumes this one
      run(request, options(FolderUse::resume, 1));
      expect_same(reference, contents(folder()));
    }
    fs::remove_all(folder());
  }
}

TEST_F(Slice, TornJournalsAndDamagedFilesAreRedone) {
  const Contents reference = expected(ball_request(), root_);
  run(ball_request(), options());
  const std::string journal = reference.at("journal.jsonl");
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    write(folder() + "/journal.jsonl", journal.substr(0, random() % journal.size()));
    write(folder() + "/slice_00011.png.part", "half");
    run(ball_request(), options(FolderUse::resume));
    expect_same(reference, contents(folder()));
  }
  std::string damaged = reference.at("slice_00020.png");
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] + 1);
  write(folder() + "/slice_00020.png", damaged);
  fs::remove(folder() + "/slice_00021.png");
  write(folder() + "/slice_00022.png", "");
  EXPECT_EQ(run(ball_request(), options(FolderUse::resume)).layers_written, 3);
  expect_same(reference, contents(folder()));
  fs::remove(folder() + "/journal.jsonl");
  run(ball_request(), options(FolderUse::resume));
  expect_same(reference, contents(folder()));
}

TEST_F(Slice, ResumingAnotherJobNamesTheDifference) {
  run(ball_request(), options());
  SliceRequest other = ball_request();
  other.seed = 2;
  expect_error([&] { run(other, options(FolderUse::resume)); }, "seed is \"0\" there and \"2\" here");
  other = ball_request();
  other.design_hash = "ffff";
  expect_error([&] { run(other, options(FolderUse::resume)); }, "design_hash is");
  other = ball_request();
  other.lattice.pitch[2] = Pitch{27, 1000};
  expect_error([&] { run(other, options(FolderUse::resume)); }, "pitch is");
  other = ball_request();
  other.materials[0].rgba[1] = 9;
  expect_error([&] { run(other, options(FolderUse::resume)); }, "materials is");
}

TEST_F(Slice, ResumeStartsAJobWhereThereIsNone) {
  EXPECT_TRUE(run(ball_request(), options(FolderUse::resume)).whole_job_finished);
}

TEST_F(Slice, ForceReplacesAJobAndLeavesForeignFilesAlone) {
  run(ball_request(), options());
  write(folder() + "/notes.txt", "mine");
  write(folder() + "/slice_00099.png", "mine too, no layer has this number");
  expect_error([&] { run(ball_request(), options()); }, "--resume");
  SliceRequest smaller = ball_request();
  smaller.lattice.count[2] = 30;
  run(smaller, options(FolderUse::replace));
  Contents reference = expected(smaller, root_);
  reference["notes.txt"] = "mine";
  reference["slice_00099.png"] = "mine too, no layer has this number";
  expect_same(reference, contents(folder()));
}

TEST_F(Slice, ForceAfterAKillLeavesNoLayerOfTheOldJob) {
  run(ball_request(), options());
  const std::string journal = formats::read_file(folder() + "/journal.jsonl");
  write(folder() + "/journal.jsonl", journal.substr(0, journal.size() / 2));
  write(folder() + "/job.json.part", "{");
  SliceRequest smaller = ball_request();
  smaller.lattice.count[2] = 10;
  run(smaller, options(FolderUse::replace));
  expect_same(expected(smaller, root_), contents(folder()));
}

TEST_F(Slice, ForeignFoldersAreRefused) {
  fs::create_directory(folder());
  write(folder() + "/thesis.tex", "years of work");
  expect_error([&] { run(ball_request(), options()); }, "thesis.tex");
  expect_error([&] { run(ball_request(), options(FolderUse::resume)); }, "thesis.tex");
  EXPECT_EQ(contents(folder()).size(), 1U);
  write(folder() + "/slice_00003.png", "a photograph");
  expect_error([&] { run(ball_request(), options(FolderUse::replace)); }, "slice_00003.png");
  fs::remove(folder() + "/slice_00003.png");
  write(folder() + "/job.json", R"({"format": "of another program"})");
  expect_error([&] { run(ball_request(), options(FolderUse::replace)); }, "not written by Ombre");
  fs::remove(folder() + "/job.json");
  run(ball_request(), options(FolderUse::replace));
  EXPECT_EQ(formats::read_file(folder() + "/thesis.tex"), "years of work");
}

TEST_F(Slice, DamagedJobFilesAreReplacedByForceAlone) {
  run(ball_request(), options());
  write(folder() + "/job.json", "{");
  expect_error([&] { run(ball_request(), options(FolderUse::resume)); }, "damaged");
  run(ball_request(), options(FolderUse::replace));
  expect_same(expected(ball_request(), root_), contents(folder()));
}

TEST_F(Slice, FoldersThatCannotBeWrittenAreErrorsWithTheirPath) {
  write(folder(), "a file");
  expect_error([&] { run(ball_request(), options()); }, folder() + " is a file");
  SliceOptions below = options();
  below.folder = folder() + "/deeper";
  expect_error([&] { run(ball_request(), below); }, "deeper");
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere: the read-only folder is not tried";
  fs::remove(folder());
  fs::create_directory(folder());
  fs::permissions(folder(), fs::perms::owner_read | fs::perms::owner_exec);
  expect_error([&] { run(ball_request(), options()); }, "choose a folder that you may write to");
}

TEST_F(Slice, AFullDiskLeavesAResumableJob) {
  fs::create_directory(folder());
  const SmallDisk disk(folder());
  if (!disk.is_mounted()) GTEST_SKIP() << "no small disk can be mounted here";
  expect_error([&] { run(ball_request(), options()); }, "free some space");
  const Contents partial = contents(folder());
  const Contents reference = expected(ball_request(), root_);
  EXPECT_LT(partial.size(), reference.size());
  for (const auto& [name, text] : partial) {
    EXPECT_FALSE(name.ends_with(".part")) << name;
    if (name.ends_with(".png")) {
      EXPECT_TRUE(text == reference.at(name)) << name;
    }
  }
  ASSERT_TRUE(disk.grow());
  run(ball_request(), options(FolderUse::resume));
  expect_same(reference, contents(folder()));
}

TEST_F(Slice, TwoRunsDoNotShareAFolder) {
  const SliceRequest request = ball_request();
  std::atomic<bool> refused{false};
  const LayerProducer intruding = [&](int64_t begin, int64_t end, const StopFlag*) {
    if (begin == 0) {
      expect_error([&] { run(request, options(FolderUse::resume)); }, "another run is writing");
      refused = true;
    }
    return ball(request)(begin, end, nullptr);
  };
  slice(request, intruding, options());
  EXPECT_TRUE(refused);
}

TEST_F(Slice, ErrorsOfTheProducerReachTheCallerAndTheJobResumes) {
  const SliceRequest request = ball_request();
  const LayerProducer failing = [&](int64_t begin, int64_t end, const StopFlag*) {
    if (begin >= 24) throw Error("the mesh is gone");
    return ball(request)(begin, end, nullptr);
  };
  expect_error([&] { slice(request, failing, options()); }, "the mesh is gone");
  run(request, options(FolderUse::resume));
  expect_same(expected(request, root_), contents(folder()));
}

}  // namespace ombre::compile
