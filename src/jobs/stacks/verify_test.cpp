#include "jobs/stacks/verify.h"

#include <algorithm>

#include "jobs/slice/job_description.h"
#include "jobs/stacks/fraction_windows.h"
#include "jobs/stacks/test_stacks.h"
#include "voxel/image_kinds.h"

namespace ombre::compile {
namespace {

using Words = std::set<std::string>;

class Verify : public StackTest {
 protected:
  std::string file(const std::string& name) const { return (fs::path(folder()) / name).string(); }

  // Replaces the first number after a text in job.json.
  void add_one_after(const std::string& text) {
    std::string job = formats::read_file(file("job.json"));
    const size_t number = job.find_first_of("0123456789", job.find(text) + text.size());
    const size_t end = job.find_first_not_of("0123456789", number);
    const int value = std::stoi(job.substr(number, end - number));
    job.replace(number, end - number, std::to_string(value > 0 ? value - 1 : 1));
    write(file("job.json"), job);
  }
};

class VerifyEach : public Verify, public testing::WithParamInterface<std::tuple<std::string, std::string>> {};

}  // namespace

TEST_P(VerifyEach, PassesWhatSliceWrites) {
  options_.dither = *voxel::dither(std::get<0>(GetParam()));
  options_.image = voxel::image_format(std::get<1>(GetParam()));
  options_.printer.flip_x = true;
  const LoadedPtr loaded = load(graded_text);
  write_stack(loaded);
  const Verification all = verified(loaded);
  EXPECT_EQ(texts(all), "");
  EXPECT_EQ(all.stack.layers, 20);
  EXPECT_EQ(all.design->voxels, uint64_t{28} * 20 * 20);
}

INSTANTIATE_TEST_SUITE_P(Stacks, VerifyEach,
                         testing::Combine(testing::Values("stochastic", "blue-noise", "diffusion", "threshold"),
                                          testing::Values("rgba", "indexed", "gray", "mask")),
                         [](const auto& test) {
                           std::string title = std::get<0>(test.param) + "_" + std::get<1>(test.param);
                           std::ranges::replace(title, '-', '_');
                           return title;
                         });

TEST_F(Verify, FindsOneVoxel) {
  const LoadedPtr loaded = load(graded_text);
  write_stack(loaded, [](const Plan& plan, int64_t k) {
    if (k != 12) return right_layer(plan, k);
    // Voxel (22, 14) is in the block, which is 10 voxels long and 5 wide from voxel (17, 12) on.
    return changed_layer(right_layer(plan, k), [&](auto& voxels, int64_t width) {
      MaterialId& voxel = voxels[static_cast<size_t>(14 * width + 22)];
      const auto& materials = plan.request.materials;
      voxel = voxel == materials.front().id ? materials.back().id : materials.front().id;
    });
  });
  EXPECT_EQ(texts(verified(nullptr)), "");  // its journal says what its images show
  const Verification all = verified(loaded);
  EXPECT_EQ(kinds(all), Words{"voxels"}) << texts(all);
  EXPECT_NE(texts(all).find("layer 12 has 1 voxel that"), std::string::npos) << texts(all);
  EXPECT_NE(texts(all).find("(22, 14)"), std::string::npos) << texts(all);
  EXPECT_EQ(all.design->pictures.size(), 1U);
}

TEST_F(Verify, ChecksSomeLayersAlone) {
  const LoadedPtr loaded = load(graded_text);
  write_stack(loaded, [](const Plan& plan, int64_t k) {
    return k != 12 ? right_layer(plan, k)
                   : changed_layer(right_layer(plan, k), [](auto& voxels, int64_t) { std::ranges::reverse(voxels); });
  });
  for (const char* others : {":12", "13:"}) {
    const Verification without = verified(loaded, {}, others);
    EXPECT_EQ(texts(without), "") << others;
    EXPECT_FALSE(without.unchecked().empty()) << others;
  }
  const Verification with = verified(loaded, {}, "10:15");
  EXPECT_EQ(with.stack.layers, 5);
  EXPECT_EQ(with.design->voxels, uint64_t{28} * 20 * 5);
  EXPECT_EQ(with.findings().size(), 1U) << texts(with);
}

TEST_F(Verify, FindsExchangedLayers) {
  const LoadedPtr loaded = load(graded_text);
  write_stack(loaded, [](const Plan& plan, int64_t k) { return right_layer(plan, k == 4 ? 9 : k == 9 ? 4 : k); });
  const Verification all = verified(loaded);
  EXPECT_EQ(kinds(all), Words{"exchanged"}) << texts(all);
  EXPECT_NE(texts(all).find("belongs into layer 9"), std::string::npos) << texts(all);
  EXPECT_NE(texts(all).find("belongs into layer 4"), std::string::npos) << texts(all);
}

TEST_F(Verify, FindsAMirroredLayer) {
  const LoadedPtr loaded = load(graded_text);
  write_stack(loaded, [](const Plan& plan, int64_t k) {
    if (k != 6) return right_layer(plan, k);
    return changed_layer(right_layer(plan, k), [](auto& voxels, int64_t width) {
      for (auto row = voxels.begin(); row != voxels.end(); row += width) std::reverse(row, row + width);
    });
  });
  const Verification all = verified(loaded);
  EXPECT_EQ(kinds(all), Words{"mirrored"}) << texts(all);
  EXPECT_NE(texts(all).find("mirrored along x"), std::string::npos) << texts(all);
}

TEST_F(Verify, FindsALayerOfAnotherSeed) {
  const LoadedPtr loaded = load(graded_text);
  options_.seed = 1;
  const Plan other = plan(loaded);
  options_.seed = 0;
  write_stack(loaded, [&](const Plan& plan, int64_t k) { return right_layer(k == 8 ? other : plan, k); });
  const Verification all = verified(loaded);
  EXPECT_EQ(kinds(all), Words{"seed"}) << texts(all);
}

TEST_F(Verify, FindsADesignWithAnotherConstant) {
  write_stack(load(graded_text));
  std::string other = graded_text;
  other.replace(other.find("(2 - z) / 4"), 11, "(3 - z) / 4");
  const Verification all = verified(load(other));
  EXPECT_TRUE(kinds(all).contains("design")) << texts(all);
  EXPECT_GT(all.findings().size(), 10U) << texts(all);
}

TEST_F(Verify, FindsAColourThatIsOffByOne) {
  for (const char* format : {"indexed", "rgba"}) {
    options_.image = voxel::image_format(format);
    write_stack(load(graded_text));
    add_one_after("\"name\": \"red\", \"id\": 1, \"rgba\": [");
    const Verification all = verified(nullptr);
    EXPECT_TRUE(kinds(all).contains("colour")) << format << "\n" << texts(all);
  }
}

TEST_F(Verify, FindsMissingExtraAndTruncatedFiles) {
  write_stack(load(graded_text));
  const std::string image = formats::read_file(file("slice_00007.png"));
  fs::remove(file("slice_00003.png"));
  write(file("slice_00020.png"), image);
  write(file("slice_00007.png"), image.substr(0, image.size() / 2));
  const Verification all = verified(nullptr);
  EXPECT_EQ(kinds(all), (Words{"missing", "extra", "hash", "unreadable"})) << texts(all);
  EXPECT_NE(texts(all).find("missing: slice_00003.png"), std::string::npos) << texts(all);
  EXPECT_NE(texts(all).find("extra: slice_00020.png"), std::string::npos) << texts(all);
}

TEST_F(Verify, NamesTheFileThatTookTheNameOfAnother) {
  write_stack(load(graded_text));
  const std::string third = formats::read_file(file("slice_00003.png"));
  write(file("slice_00003.png"), formats::read_file(file("slice_00005.png")));
  write(file("slice_00005.png"), third);
  const std::string text = texts(verified(nullptr));
  EXPECT_NE(text.find("slice_00003.png is not the file that the journal names: it has the bytes of slice_00005.png"),
            std::string::npos)
      << text;
}

TEST_F(Verify, FindsWrongTotalsAndTornJournals) {
  write_stack(load(graded_text));
  add_one_after("\"voxels\": ");  // the first ones are of the lattice
  EXPECT_TRUE(kinds(verified(nullptr)).contains("size"));
  write_stack(load(graded_text));
  add_one_after("\"bytes\": ");
  EXPECT_EQ(kinds(verified(nullptr)), Words{"totals"});
  write(file("journal.jsonl"), formats::read_file(file("journal.jsonl")) + "{\"layer\": 3, \"fil");
  EXPECT_EQ(kinds(verified(nullptr)), (Words{"totals", "journal"}));
}

TEST_F(Verify, ShadesMayBeRoundedButNotChanged) {
  options_.value = ValueChoice{"red", Interval(0, 1), 8};
  const LoadedPtr loaded = load(graded_text);
  write_stack(loaded);
  EXPECT_EQ(texts(verified(loaded)), "");
  write_stack(loaded, [](const Plan& plan, int64_t k) {
    if (k != 12) return right_layer(plan, k);
    return changed_layer(right_layer(plan, k), [](auto& voxels, int64_t width) {
      MaterialId& shade = voxels[static_cast<size_t>(10 * width + 10)];
      shade = static_cast<MaterialId>(shade - 20);
    });
  });
  EXPECT_EQ(kinds(verified(loaded)), Words{"voxels"});
}

TEST_F(Verify, SaysHowMuchIsCompared) {
  const LoadedPtr loaded = load(graded_text);
  write_stack(loaded);
  SampleChoice few;
  few.voxels = 1000;
  few.borders = {7};
  const Verification all = verified(loaded, few);
  EXPECT_EQ(texts(all), "");
  EXPECT_GE(all.design->voxels, uint64_t{2} * 28 * 20);  // both layers at the border
  EXPECT_LT(all.design->voxels, uint64_t{28} * 20 * 20);
  const auto says = [](const std::string& text) { return text.find("are evaluated again") != std::string::npos; };
  EXPECT_TRUE(std::ranges::any_of(all.unchecked(), says));
}

TEST_F(Verify, JobsAreReadAsTheyAreDescribed) {
  options_.dither = voxel::Dither::blue_noise;
  options_.seed = UINT64_MAX;
  const SliceRequest request = plan(load(graded_text)).request;
  Diagnostics diagnostics;
  const auto read = read_job(make_source("job.json", print_json(describe_job(request))), diagnostics);
  ASSERT_TRUE(read) << to_text(diagnostics);
  EXPECT_EQ(first_difference(describe_job(request), describe_job(read->request)), "");
}

TEST(LayerSamples, AreTheSameForASeedAndDoNotOverlap) {
  const voxel::Lattice lattice{{0, 0, 0}, {Pitch{1, 10}, Pitch{1, 10}, Pitch{1, 10}}, {1000, 700, 500}};
  const LayerRange all{0, 500};
  SampleChoice choice;
  choice.voxels = 3e6;
  choice.borders = {100};
  std::set<std::array<int64_t, 3>> seen;
  double voxels = 0;
  bool has_border = false;
  for (const LayerSample& sample : choose_samples(lattice, all, choice))
    for (const LayerWindow& window : sample.windows) {
      EXPECT_TRUE(seen.insert({sample.layer, window.lo[0], window.lo[1]}).second);
      voxels += static_cast<double>((window.hi[0] - window.lo[0]) * (window.hi[1] - window.lo[1]));
      has_border |= sample.layer == 99 && window.hi[0] == 1000;
    }
  EXPECT_TRUE(has_border);
  EXPECT_GE(voxels, 3e6);
  EXPECT_LT(voxels, 3e6 + 128 * 128);
  const auto first = choose_samples(lattice, all, choice), again = choose_samples(lattice, all, choice);
  choice.seed = 1;
  const auto other = choose_samples(lattice, all, choice);
  const auto layer_list = [](const std::vector<LayerSample>& samples) {
    std::vector<int64_t> layers;
    for (const LayerSample& sample : samples) layers.push_back(sample.layer);
    return layers;
  };
  EXPECT_EQ(layer_list(first), layer_list(again));
  EXPECT_NE(layer_list(first), layer_list(other));
}

// 64 x 64 voxels of a half: alternating ones have the expected number in each window, and none of the material has a
// chi square of 256 for each of the 16 windows.
TEST(FractionWindows, FitTheirMixtureOrNot) {
  SliceRequest request;
  request.materials = {{"red", 1, {255, 0, 0, 255}}};
  const Appearance appearance(request);
  const std::vector<voxel::ChannelPixels> half{voxel::Raster<uint16_t>{64, std::vector<uint16_t>(64 * 64, 32768)}};
  Shown alternating(64 * 64), none(64 * 64);
  for (size_t n = 0; n < alternating.size(); ++n) alternating[n] = n % 2;
  FractionWindows right(request.materials, appearance), wrong(request.materials, appearance);
  right.add(64, alternating, half);
  wrong.add(64, none, half);
  EXPECT_EQ(right.windows(), 16U);
  EXPECT_NEAR(right.expected_changes(), 64 * 64 * 0.25, 0.01);
  EXPECT_EQ(right.misfit(), std::nullopt);
  EXPECT_EQ(wrong.misfit(), "red");
}

// Two materials of one gray are told apart by nothing, so that all voxels fit if both have a half.
TEST(FractionWindows, MaterialsWithTheSamePixelsAreOne) {
  SliceRequest request;
  request.format = ImageFormat::gray;
  request.materials = {{"pale", 1, {100, 100, 100, 255}}, {"dull", 2, {100, 100, 100, 255}}};
  const Appearance appearance(request);
  EXPECT_EQ(appearance.hidden(), std::vector<std::string>{"dull"});
  const std::vector<voxel::ChannelPixels> halves(2, voxel::Raster<uint16_t>{64, std::vector<uint16_t>(64 * 64, 32768)});
  FractionWindows windows(request.materials, appearance);
  windows.add(64, Shown(64 * 64, 1), halves);
  EXPECT_EQ(windows.misfit(), std::nullopt);
}

}  // namespace ombre::compile
