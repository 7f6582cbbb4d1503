#include <chrono>
#include <thread>

#include "jobs/test_slices.h"

#include "export/output_file.h"
#include "jobs/slice/layer_files.h"
#include "jobs/slice/slice_work.h"
#include "jobs/stacks/job_sheet.h"

namespace ombre::compile {

TEST_F(Slice, WritesEveryLayerWithTheBallInIt) {
  const SliceRequest request = ball_request();
  const SliceReport report = run(request, options());
  EXPECT_TRUE(report.whole_job_finished);
  EXPECT_EQ(report.layers_written, 40);
  EXPECT_EQ(report.layers_kept, 0);
  uint64_t inside = 0;
  for (int64_t k = 0; k < 40; ++k) {
    const std::array<uint64_t, 256> counts = count_materials(ball_layer(request, k, false).materials());
    inside += counts[1] + counts[5];
    const std::string name = request.files.name(k);
    const formats::PngImage image = formats::decode_png(formats::read_file(folder() + "/" + name), name);
    EXPECT_EQ(image.bit_depth, counts[5] > 0 ? 2 : 1);  // blue is entry 2
    EXPECT_EQ(image.dots_per_metre_x, 10000U);
    EXPECT_EQ(image.dots_per_metre_y, 5000U);
    uint64_t blue = 0;
    for (const uint8_t pixel : image.pixels) blue += pixel == 2 ? 1 : 0;
    EXPECT_EQ(blue, counts[5]) << name;
  }
  EXPECT_EQ(report.voxels_inside, inside);
  EXPECT_EQ(report.counts.voxels[0] + report.counts.voxels[1], inside);
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

TEST_F(Slice, ProgressGrowsToTheTotal) {
  struct Recorder : Progress {
    std::vector<std::pair<uint64_t, uint64_t>> seen;
    void update(const HowFar& how_far) override { seen.emplace_back(how_far.done, how_far.total); }
  } recorder;
  const SliceRequest request = ball_request();
  slice(request, ball(request), options(), &recorder);
  ASSERT_EQ(recorder.seen.size(), 6U);  // once for existing layers, once for each slab
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
  size_t before = 0;  // error diffusion and larger images take more memory
  for (const auto& [dither, format] : {std::pair{voxel::Dither::stochastic, ImageFormat::indexed},
                                       std::pair{voxel::Dither::diffusion, ImageFormat::indexed},
                                       std::pair{voxel::Dither::diffusion, ImageFormat::rgba}}) {
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
  const SliceEstimate estimate = estimate_slice(request, ball_rows(request), options());
  EXPECT_GT(estimate.bytes, 4000U * 60);
  EXPECT_GT(estimate.seconds, 0);
  EXPECT_FALSE(fs::exists(folder()));
}

// A layer that would take forever is stopped when the time is over.
TEST_F(Slice, EstimatesEndInTime) {
  SliceRequest request = ball_request();
  request.lattice.count[2] = 4000;
  const RegionProducer slow = [](const voxel::TileBox&, const StopFlag* stop) -> std::vector<voxel::LayerResult> {
    while (!stop->requested()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    throw Cancelled();
  };
  SliceOptions one = options();
  one.threads = 1;
  const SliceEstimate estimate = estimate_slice(request, slow, one);
  EXPECT_TRUE(estimate.is_least);
  EXPECT_GE(estimate.seconds, 4000 / 8 * 4);  // slabs of 8 layers, four seconds each
  StopFlag stop;
  stop.request();
  EXPECT_THROW(estimate_slice(request, slow, one, &stop), Cancelled);
}

// A slab of such layers takes 16 s, so none is whole after the four seconds of an estimate.
TEST_F(Slice, EstimatesOfSlowLayersComeFromTheirRows) {
  SliceRequest request = ball_request();
  request.lattice.pitch[1] = Pitch{1, 500};
  request.lattice.pitch[2] = Pitch{1, 100};
  request.lattice.count = {40, 2000, 400};
  const RegionProducer slow = [rows = ball_rows(request)](const voxel::TileBox& box, const StopFlag* stop) {
    std::this_thread::sleep_for(std::chrono::milliseconds(box.size(1) * box.size(2)));
    return rows(box, stop);
  };
  const SliceEstimate estimate = estimate_slice(request, slow, options());
  EXPECT_FALSE(estimate.is_least);
  EXPECT_GE(estimate.seconds, 0.99 * 400 * 2000 * 1e-3 / 2);  // a millisecond for each row, on two threads
  const uint64_t whole = run(request, options()).bytes_written;
  // A slow machine has time for few rows, and each of their files begins with a header.
  EXPECT_GT(estimate.bytes, whole / 4);
  EXPECT_LT(estimate.bytes, whole * 4);
}

TEST_F(Slice, EstimatesFollowTheShape) {
  SliceRequest request = ball_request();
  const auto bytes = [&] { return estimate_slice(request, ball_rows(request), options()).bytes; };
  EXPECT_EQ(bytes(), run(request, options()).bytes_written);  // a small job is sampled whole
  request.lattice.pitch[2] = Pitch{1, 500};
  request.lattice.count[2] = 2000;
  const auto whole = static_cast<double>(run(request, options(FolderUse::replace)).bytes_written);
  EXPECT_NEAR(static_cast<double>(bytes()) / whole, 1, 0.1);
}

TEST_F(Slice, ContactSheetsKeepTrueProportions) {
  run(ball_request(), options());
  const std::string sheet = folder("sheet.png");
  exporting::write_file(sheet, contact_sheet(folder(), 6));
  const formats::PngImage image = formats::decode_png(formats::read_file(sheet), sheet);
  EXPECT_LE(image.width, 1600U);
  // The ball's pixels are twice as high as wide. The contact sheet shows its widest layer as wide as high.
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
  expect_error([&] { contact_sheet(folder("nothing"), 6); }, "nothing");
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
