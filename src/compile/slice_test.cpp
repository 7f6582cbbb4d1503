#include "compile/slice.h"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <thread>

#include "base/error.h"
#include "base/json.h"
#include "compile/job_sheet.h"
#include "compile/layer_files.h"
#include "compile/slice_work.h"
#include "formats/file.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;
using Contents = std::map<std::string, std::string>;

// A folder of its own for each test.
class Slice : public testing::Test {
 protected:
  Slice() {
    std::string name = (fs::temp_directory_path() / "ombre_slice_XXXXXX").string();
    root_ = ::mkdtemp(name.data());
  }
  ~Slice() override {
    std::error_code ignored;
    fs::permissions(root_, fs::perms::owner_all, ignored);
    fs::remove_all(root_, ignored);
  }

  std::string folder(const std::string& name = "job") const { return (root_ / name).string(); }

  SliceOptions options(FolderUse use = FolderUse::fresh, int threads = 2) const {
    SliceOptions options;
    options.folder = folder();
    options.use = use;
    options.threads = threads;
    return options;
  }

  fs::path root_;
};

SliceRequest ball_request() {
  SliceRequest request;
  request.program = "ombre test";
  request.design_hash = "0123456789abcdef0123456789abcdef";
  request.printer = "generic";
  request.lattice = {{-2, -2, -2}, {Pitch{1, 10}, Pitch{1, 5}, Pitch{1, 10}}, {40, 20, 40}};
  request.materials = {{"red", 1, {255, 0, 0, 255}}, {"blue", 5, {0, 0, 255, 255}}};
  request.check_texts = {"the core is hot"};
  return request;
}

// Masks: a file for each of two materials.
SliceRequest mask_request() {
  SliceRequest request = ball_request();
  voxel::Printer printer;
  printer.name = "vat";
  use_printer(request, printer, voxel::ImageFormat::mask);
  return request;
}

// A ball, one material in each half, whose lowest and highest layers are empty. Voxels near its
// centre fail the check.
voxel::LayerResult ball_layer(const SliceRequest& request, int64_t k, bool with_checks) {
  voxel::LayerResult result;
  result.checks.resize(request.check_texts.size());
  const auto& lattice = request.lattice;
  result.runs = RunLayer(static_cast<uint32_t>(lattice.count[0]));
  for (int64_t j = 0; j < lattice.count[1]; ++j) {
    for (int64_t i = 0; i < lattice.count[0]; ++i) {
      const Vec3 p = lattice.center(i, j, k);
      const MaterialId id = length(p) > 1.7 ? 0 : p.x < 0.3 * p.z ? 1 : 5;
      result.runs.add_uniform(id, 1);
      ++result.material_counts[id];
      if (!with_checks || length(p) > 0.3) continue;
      if (result.checks[0].count++ == 0) result.checks[0].first = {i, j, k};
    }
    result.runs.end_row();
  }
  return result;
}

LayerProducer ball(const SliceRequest& request, bool with_checks = true) {
  return [request, with_checks](int64_t begin, int64_t end, const StopFlag*) {
    std::vector<voxel::LayerResult> layers;
    for (int64_t k = begin; k < end; ++k) layers.push_back(ball_layer(request, k, with_checks));
    return layers;
  };
}

Contents contents(const fs::path& folder) {
  Contents all;
  for (const auto& entry : fs::directory_iterator(folder))
    all[entry.path().filename().string()] = formats::read_file(entry.path().string());
  return all;
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

SliceReport run(const SliceRequest& request, const SliceOptions& options) {
  return slice(request, ball(request), options);
}

// What an uninterrupted run on one thread leaves.
Contents expected(const SliceRequest& request, const fs::path& root) {
  SliceOptions options;
  options.folder = (root / "expected").string();
  options.threads = 1;
  run(request, options);
  Contents all = contents(options.folder);
  fs::remove_all(options.folder);
  return all;
}

// A small disk mounted on a folder, where this is allowed.
class SmallDisk {
 public:
  explicit SmallDisk(const std::string& folder)
      : folder_(folder), mounted_(::mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=80k") == 0) {}
  ~SmallDisk() {
    if (mounted_) ::umount(folder_.c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool is_mounted() const { return mounted_; }
  bool grow() const { return ::mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT, "size=10m") == 0; }

 private:
  std::string folder_;
  bool mounted_;
};

void expect_error(const std::function<void()>& act, const std::string& part) {
  try {
    act();
    ADD_FAILURE() << "no error about: " << part;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

void expect_same(const Contents& a, const Contents& b) {
  for (const auto& [name, text] : a) {
    ASSERT_TRUE(b.count(name)) << name << " is missing";
    EXPECT_TRUE(b.at(name) == text) << name << " differs";
  }
  EXPECT_EQ(a.size(), b.size());
}

// Asks to stop once `after` slabs have begun.
LayerProducer stopping(const LayerProducer& producer, StopFlag& stop, int after) {
  auto begun = std::make_shared<std::atomic<int>>(0);
  return [=, &stop](int64_t begin, int64_t end, const StopFlag*) {
    if (++*begun > after) stop.request();
    return producer(begin, end, nullptr);
  };
}

Data job_json(const std::string& folder) {
  Diagnostics diagnostics;
  auto job = parse_json(make_source("job.json", formats::read_file(folder + "/job.json")), diagnostics);
  EXPECT_TRUE(job) << to_text(diagnostics);
  return job.value_or(Data());
}

}  // namespace

TEST_F(Slice, WritesEveryLayerWithTheBallInIt) {
  const SliceRequest request = ball_request();
  const SliceReport report = run(request, options());
  EXPECT_TRUE(report.whole_job_finished);
  EXPECT_EQ(report.layers_written, 40);
  EXPECT_EQ(report.layers_kept, 0);
  uint64_t inside = 0;
  for (int64_t k = 0; k < 40; ++k) {
    const voxel::LayerResult layer = ball_layer(request, k, false);
    inside += layer.material_counts[1] + layer.material_counts[5];
    const std::string name = request.files.name(k);
    const formats::PngImage image = formats::decode_png(formats::read_file(folder() + "/" + name), name);
    EXPECT_EQ(image.bit_depth, 2);
    EXPECT_EQ(image.dots_per_metre_x, 10000U);
    EXPECT_EQ(image.dots_per_metre_y, 5000U);
    uint64_t blue = 0;
    for (const uint8_t pixel : image.pixels) blue += pixel == 2 ? 1 : 0;
    EXPECT_EQ(blue, layer.material_counts[5]) << name;
  }
  EXPECT_EQ(report.voxels_inside, inside);
  EXPECT_EQ(report.material_voxels[0] + report.material_voxels[1], inside);
  const Data job = job_json(folder());
  EXPECT_EQ(*job.find("status")->string(), "complete");
  ASSERT_TRUE(job.find("totals"));
  EXPECT_EQ(*job.find("totals")->find("first_and_last_layer"), Data(DataList{3.0, 36.0}));
}

TEST_F(Slice, ChecksAreCountedWithTheirLowestVoxel) {
  const SliceReport report = run(ball_request(), options());
  ASSERT_EQ(report.checks.size(), 1U);
  EXPECT_EQ(report.checks[0].text, "the core is hot");
  EXPECT_GT(report.checks[0].voxels, 10U);
  EXPECT_NEAR(report.checks[0].first_mm.z, -0.25, 1e-9);
}

TEST_F(Slice, StrictStopsAtTheFirstFailedCheck) {
  SliceOptions strict = options(FolderUse::fresh, 1);
  strict.strict = true;
  const SliceReport report = run(ball_request(), strict);
  EXPECT_TRUE(report.stopped_by_check);
  EXPECT_LT(report.layers_written, 40);
  EXPECT_EQ(report.checks.size(), 1U);
  strict.use = FolderUse::resume;
  EXPECT_TRUE(run(ball_request(), strict).stopped_by_check);
  expect_same(expected(ball_request(), root_), (run(ball_request(), options(FolderUse::resume)), contents(folder())));
}

TEST_F(Slice, ThreadsAndMemoryDoNotChangeTheFolder) {
  const Contents reference = expected(ball_request(), root_);
  for (const int threads : {1, 2, 4}) {
    for (const size_t memory : {size_t{1}, size_t{100000}, size_t{1} << 30}) {
      SliceOptions some = options(FolderUse::replace, threads);
      some.memory_bytes = memory;
      run(ball_request(), some);
      expect_same(reference, contents(folder()));
    }
  }
}

TEST_F(Slice, PartsOfAJobAddUpToTheWhole) {
  const Contents reference = expected(ball_request(), root_);
  SliceOptions part = options();
  part.layers = LayerRange{13, 29};
  EXPECT_FALSE(run(ball_request(), part).whole_job_finished);
  Contents so_far = contents(folder());
  EXPECT_EQ(so_far.size(), 16U + 2);
  EXPECT_EQ(so_far.at("slice_00020.png"), reference.at("slice_00020.png"));
  part.use = FolderUse::resume;
  part.layers = LayerRange{0, 20};
  EXPECT_EQ(run(ball_request(), part).layers_kept, 7);
  part.layers = LayerRange{25, 40};
  EXPECT_TRUE(run(ball_request(), part).whole_job_finished);
  expect_same(reference, contents(folder()));
}

TEST_F(Slice, EmptyLayersCanBeDropped) {
  SliceRequest request = ball_request();
  request.drop_empty_layers = true;
  request.first_index = 1;
  const SliceReport report = run(request, options());
  EXPECT_EQ(report.layers_dropped, 6);
  EXPECT_EQ(report.layers_written, 34);
  EXPECT_FALSE(fs::exists(folder() + "/slice_00003.png"));
  EXPECT_TRUE(fs::exists(folder() + "/slice_00004.png"));  // layer 3
  const Contents whole = contents(folder());
  EXPECT_EQ(run(request, options(FolderUse::resume)).layers_kept, 40);
  expect_same(whole, contents(folder()));
}

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

TEST_F(Slice, StopsWhileASlabIsMade) {
  const SliceRequest request = ball_request();
  StopFlag stop;
  const LayerProducer cancelling = [&](int64_t begin, int64_t end, const StopFlag* asked) {
    EXPECT_EQ(asked, &stop);
    if (begin == 16) {
      stop.request();
      throw Cancelled();
    }
    return ball(request)(begin, end, asked);
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
      if (round % 2) continue;  // then the next run resumes what this one left
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

TEST_F(Slice, ProgressGrowsToTheTotal) {
  struct Recorder : Progress {
    std::vector<std::pair<uint64_t, uint64_t>> seen;
    void update(const HowFar& how_far) override { seen.emplace_back(how_far.done, how_far.total); }
  } recorder;
  const SliceRequest request = ball_request();
  slice(request, ball(request), options(), &recorder);
  ASSERT_EQ(recorder.seen.size(), 6U);  // once for what was there before, once for each slab
  EXPECT_EQ(recorder.seen.front().first, 0U);
  for (size_t i = 1; i < recorder.seen.size(); ++i) EXPECT_GT(recorder.seen[i].first, recorder.seen[i - 1].first);
  EXPECT_EQ(recorder.seen.back(), (std::pair{request.lattice.voxels(), request.lattice.voxels()}));
}

TEST_F(Slice, MemoryBoundsWhatIsInFlight) {
  SliceRequest request = ball_request();
  request.lattice.count = {11575, 4606, 7407};
  SliceOptions some = options();
  some.threads = 16;
  for (const size_t memory : {size_t{2} << 30, size_t{8} << 30, size_t{64} << 30}) {
    some.memory_bytes = memory;
    EXPECT_LE(size_work(request, some).memory_bytes, memory);
  }
  some.threads = 1;
  size_t before = 0;  // what is kept for error diffusion, and larger images, take memory
  for (const auto& [dither, format] : {std::pair{voxel::Dither::stochastic, voxel::ImageFormat::indexed},
                                       std::pair{voxel::Dither::diffusion, voxel::ImageFormat::indexed},
                                       std::pair{voxel::Dither::diffusion, voxel::ImageFormat::rgba}}) {
    request.dither = dither;
    request.format = format;
    EXPECT_GT(size_work(request, some).memory_bytes, before);
    before = size_work(request, some).memory_bytes;
  }
  some.memory_bytes = 1;
  EXPECT_EQ(size_work(request, some).window, 1U);
  EXPECT_EQ(size_work(request, some).slab_layers, 1);
}

TEST_F(Slice, EstimatesWriteNothing) {
  SliceRequest request = ball_request();
  request.lattice.count[2] = 4000;
  const SliceEstimate estimate = estimate_slice(request, ball(request), options());
  EXPECT_GT(estimate.bytes, 4000U * 60);
  EXPECT_GT(estimate.seconds, 0);
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(Slice, EstimatesFollowTheShape) {
  SliceRequest request = ball_request();
  const auto bytes = [&] { return estimate_slice(request, ball(request), options()).bytes; };
  EXPECT_EQ(bytes(), run(request, options()).bytes_written);  // it looks at all of a small job
  request.lattice.pitch[2] = Pitch{1, 500};
  request.lattice.count[2] = 2000;
  const auto whole = static_cast<double>(run(request, options(FolderUse::replace)).bytes_written);
  EXPECT_NEAR(static_cast<double>(bytes()) / whole, 1, 0.1);
}

TEST_F(Slice, ContactSheetsKeepTrueProportions) {
  run(ball_request(), options());
  const std::string sheet = folder("sheet.png");
  write_contact_sheet(folder(), sheet, 6);
  const formats::PngImage image = formats::decode_png(formats::read_file(sheet), sheet);
  EXPECT_LE(image.width, 1600U);
  // The ball's pixels are twice as high as wide. Its widest tile shows it as wide as high.
  const formats::Rgba red{255, 0, 0, 255}, blue{0, 0, 255, 255};
  uint32_t widest = 0, tallest = 0;
  for (uint32_t row = 0; row < image.height; ++row) {
    uint32_t length = 0;
    for (uint32_t column = 0; column < image.width; ++column) {
      length = image.colour(column, row) == red || image.colour(column, row) == blue ? length + 1 : 0;
      widest = std::max(widest, length);
    }
  }
  for (uint32_t column = 0; column < image.width; ++column) {
    uint32_t length = 0;
    for (uint32_t row = 0; row < image.height; ++row) {
      length = image.colour(column, row) == red || image.colour(column, row) == blue ? length + 1 : 0;
      tallest = std::max(tallest, length);
    }
  }
  EXPECT_GT(widest, 100U);
  EXPECT_NEAR(static_cast<double>(tallest) / widest, 1.0, 0.1);
  expect_error([&] { write_contact_sheet(folder("nothing"), sheet, 6); }, "nothing");
}

TEST_F(Slice, MasksShowEachMaterialInAFileOfItsOwn) {
  const SliceRequest request = mask_request();
  EXPECT_EQ(request.files.text(), "slice_{index:05}_{material}.png");
  const SliceReport report = run(request, options());
  EXPECT_EQ(report.layers_written, 40);
  const Contents all = contents(folder());
  EXPECT_EQ(all.size(), 80U + 2);
  for (int64_t k = 0; k < 40; ++k) {
    const voxel::LayerResult layer = ball_layer(request, k, false);
    for (const SliceMaterial& material : request.materials) {
      const std::string name = request.files.of_material(material.name).name(k);
      const formats::PngImage image = formats::decode_png(all.at(name), name);
      EXPECT_EQ(image.bit_depth, 1);
      uint64_t white = 0;
      for (uint32_t row = 0; row < image.height; ++row)
        for (uint32_t column = 0; column < image.width; ++column) white += image.colour(column, row)[0] == 255 ? 1 : 0;
      EXPECT_EQ(white, layer.material_counts[material.id]) << name;
    }
  }
  const Data job = job_json(folder());
  EXPECT_EQ(*job.find("totals")->find("files"), Data(80.0));
}

TEST_F(Slice, MasksOfEmptyLayersCanBeDropped) {
  SliceRequest request = mask_request();
  request.drop_empty_layers = true;
  EXPECT_EQ(run(request, options()).layers_dropped, 6);
  EXPECT_EQ(contents(folder()).size(), 2 * 34U + 2);
  EXPECT_FALSE(fs::exists(folder() + "/slice_00000_red.png"));
  EXPECT_EQ(run(request, options(FolderUse::resume)).layers_kept, 40);
}

TEST_F(Slice, LayersThatLackAFileAreRedone) {
  const SliceRequest request = mask_request();
  const Contents reference = expected(request, root_);
  run(request, options());
  fs::remove(folder() + "/slice_00011_blue.png");
  write(folder() + "/slice_00020_red.png", "damaged");
  write(folder() + "/slice_00030_red.png.part", "half");
  EXPECT_EQ(run(request, options(FolderUse::resume)).layers_written, 2);
  expect_same(reference, contents(folder()));
  // Ended between the two files of a layer: no line names them.
  const std::string& journal = reference.at("journal.jsonl");
  write(folder() + "/journal.jsonl", journal.substr(0, journal.find("\n", journal.size() / 2) + 1));
  run(request, options(FolderUse::resume));
  expect_same(reference, contents(folder()));
}

TEST_F(Slice, ForceReplacesMasks) {
  run(mask_request(), options());
  write(folder() + "/slice_00003_green.png", "mine, no material has this name");
  run(ball_request(), options(FolderUse::replace));
  Contents reference = expected(ball_request(), root_);
  reference["slice_00003_green.png"] = "mine, no material has this name";
  expect_same(reference, contents(folder()));
  write(folder() + "/slice_00003_red.png", "mine as well");
  expect_error([&] { run(mask_request(), options(FolderUse::replace)); }, "slice_00003_red.png");
}

TEST_F(Slice, ContactSheetsOfMasksHaveTheColoursOfMaterials) {
  run(mask_request(), options());
  const std::string sheet = folder("sheet.png");
  write_contact_sheet(folder(), sheet, 1);
  const formats::PngImage image = formats::decode_png(formats::read_file(sheet), sheet);
  uint64_t red = 0, blue = 0, white = 0;
  for (uint32_t row = 0; row < image.height; ++row)
    for (uint32_t column = 0; column < image.width; ++column) {
      const formats::Rgba colour = image.colour(column, row);
      red += colour == formats::Rgba{255, 0, 0, 255} ? 1 : 0;
      blue += colour == formats::Rgba{0, 0, 255, 255} ? 1 : 0;
      white += colour == formats::Rgba{255, 255, 255, 255} ? 1 : 0;
    }
  EXPECT_GT(red, 10000U);
  EXPECT_GT(blue, 10000U);
  EXPECT_EQ(white, 0U);
}

TEST(LayerFiles, WordsOfMaterialsAreDistinct) {
  EXPECT_EQ(file_words({"red", "Agilus 30", "a/b", "a b", "A-B", "-x", "\u00e4"}),
            (std::vector<std::string>{"red", "Agilus_30", "a_b", "a_b-2", "A-B", "_x", "__"}));
}

TEST(LayerRange, FollowsPython) {
  EXPECT_EQ(parse_layer_range("2:5", 10), (LayerRange{2, 5}));
  EXPECT_EQ(parse_layer_range(":5", 10), (LayerRange{0, 5}));
  EXPECT_EQ(parse_layer_range("7:", 10), (LayerRange{7, 10}));
  EXPECT_EQ(parse_layer_range(":", 10), (LayerRange{0, 10}));
  EXPECT_EQ(parse_layer_range("7:99", 10), (LayerRange{7, 10}));
  EXPECT_EQ(parse_layer_range("-3:", 10), (LayerRange{7, 10}));
  EXPECT_EQ(parse_layer_range("4", 10), (LayerRange{4, 5}));
  EXPECT_EQ(parse_layer_range("-1", 10), (LayerRange{9, 10}));
  for (const char* none : {"", "10", "-11", "5:5", "5:2", "10:20", "a:b", "1.5", "1:2:3", "1e99:"})
    EXPECT_FALSE(parse_layer_range(none, 10)) << none;
}

}  // namespace ombre::compile
