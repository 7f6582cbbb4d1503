// Tests of frames in DICOM files: their places, scales, phases, padding and labels.
#include "dicom/test_dicom_files.h"

namespace ombre::dicom {
namespace {

constexpr Tag sop_class{0x0008, 0x0016}, image_type{0x0008, 0x0008}, frame_count{0x0028, 0x0008},
    padding_value{0x0028, 0x0120}, padding_limit{0x0028, 0x0121}, temporal_position{0x0020, 0x0100},
    segmentation_type{0x0062, 0x0001}, segments{0x0062, 0x0002}, shared_groups{0x5200, 0x9229},
    frame_groups{0x5200, 0x9230}, offsets{0x3004, 0x000c}, dose_scaling{0x3004, 0x000e};

std::string place(double height) { return "-10\\20\\" + std::to_string(height); }

// A frame's functional groups: its place, its scale and its segment.
Elements group(double height, const std::string& slope_text = "1", uint32_t segment = 0) {
  Elements groups{{{0x0020, 0x9113}, sequence({{{position, {"DS", place(height)}}}})},
                  {{0x0028, 0x9145}, sequence({{{intercept, {"DS", "0"}}, {slope, {"DS", slope_text}}}})}};
  if (segment > 0) groups[{0x0062, 0x000a}] = sequence({{{{0x0062, 0x000b}, number(segment)}}});
  return groups;
}

// An enhanced file (part 3, C.7.6.16): what frames share, and the groups of each.
Elements enhanced(const std::vector<Elements>& groups, const std::vector<int16_t>& values) {
  Elements file = slice(0, values);
  for (const Tag& tag : {position, orientation, pixel_spacing, slope, intercept}) file.erase(tag);
  file.erase({0x0018, 0x0050});
  file[sop_class].second = "1.2.840.10008.5.1.4.1.1.2.1";
  file[frame_count] = {"IS", std::to_string(groups.size())};
  file[shared_groups] = sequence(
      {{{{0x0020, 0x9116}, sequence({{{orientation, {"DS", "1\\0\\0\\0\\1\\0"}}}})},
        {{0x0028, 0x9110}, sequence({{{{0x0018, 0x0050}, {"DS", "2"}}, {pixel_spacing, {"DS", "0.5\\0.25"}}}})}}});
  file[frame_groups] = sequence(groups);
  return file;
}

}  // namespace

TEST_F(Dicom, FramesLieWhereTheirGroupsSay) {
  put(enhanced({group(9), group(5), group(7, "3")}, {5, 6, 1, 2, 3, 4}));
  const Series series = read();
  EXPECT_EQ(series.count, (std::array<int64_t, 3>{2, 1, 3}));
  EXPECT_EQ(series.whole, (std::vector<int16_t>{1, 2, 9, 12, 5, 6}));
  EXPECT_EQ(series.lps_from_index({0, 0, 0}), (Vec3{-10, 20, 5}));
  EXPECT_EQ(series.lps_from_index({1, 1, 1}), (Vec3{-9.75, 20.5, 7}));
}

TEST_F(Dicom, OneFrameIsAsThickAsItSays) {
  put(enhanced({group(4)}, {1, 2}));
  EXPECT_EQ(read().lps_from_index({0, 0, 1}), (Vec3{-10, 20, 6}));
}

TEST_F(Dicom, GroupsAreThereForEachFrame) {
  Elements file = enhanced({group(4)}, {1, 2, 3, 4});
  file[frame_count].second = "2";
  put(file);
  EXPECT_NE(failure().find("functional groups for 1 frames, and 2 frames"), std::string::npos) << failure();
}

// Part 3, C.8.8.3: doses are the stored numbers times their scaling, at offsets along the normal.
TEST_F(Dicom, DosesAreScaledAtTheirOffsets) {
  Elements file = slice(5, {1, 2, 3, 4});
  for (const Tag& tag : {slope, intercept}) file.erase(tag);
  file[frame_count] = {"IS", "2"};
  file[offsets] = {"DS", "0\\2.5"};
  file[dose_scaling] = {"DS", "0.5"};
  put(file);
  EXPECT_EQ(read().real, (std::vector<float>{0.5, 1, 1.5, 2}));
  EXPECT_EQ(read().lps_from_index({0, 0, 1}), (Vec3{-10, 20, 7.5}));
  files_.clear();
  file[offsets] = {"DS", "0\\2.5\\5"};
  put(file);
  EXPECT_NE(failure().find("offsets for 3 of its 2 frames"), std::string::npos) << failure();
}

TEST_F(Dicom, PhasesAreChosen) {
  for (int phase = 0; phase < 2; ++phase)
    for (const double height : {0, 1, 2}) {
      Elements file = slice(height, {static_cast<int16_t>(512 + phase), 512});
      file[temporal_position] = {"IS", std::to_string(phase + 1)};
      put(file);
    }
  EXPECT_EQ(failure(),
            "the scan \"scan\" holds 2 volumes at the same places: phase=1: temporal position 1; phase=2: "
            "temporal position 2; choose one by phase=1, up to 2");
  EXPECT_EQ(read({.phase = 2}).whole, (std::vector<int16_t>{2, 0, 2, 0, 2, 0}));
  EXPECT_NE(failure({.phase = 3}).find("has no phase 3; 1 to 2 are there"), std::string::npos);
}

TEST_F(Dicom, PlacesWithOtherPhasesAreAnError) {
  for (int n = 0; n < 5; ++n) {
    Elements file = slice(n % 3, {1, 2});
    file[temporal_position] = {"IS", std::to_string(n / 3 + 1)};
    put(file);
  }
  EXPECT_NE(failure().find("holds 2 volumes at some places and 1 at others"), std::string::npos) << failure();
}

TEST_F(Dicom, PaddingIsOutside) {
  Elements file = slice(0, {-7, 512, 513, -8});
  file[columns] = number(4);
  file[padding_value] = {"SS", little(0xfff9, 2)};  // -7
  put(file);
  EXPECT_EQ(read({.outside = 40}).whole, (std::vector<int16_t>{40, 0, 2, -1040}));
  EXPECT_EQ(read().whole[0], -1040);
  EXPECT_EQ(read({.is_outside_high = true}).whole[0], 2);
  // Padding lies beyond the level of a solid that holds all other numbers.
  EXPECT_EQ(read({.level = -1000}).whole[0], -1040);
  EXPECT_EQ(read({.level = -1050}).whole[0], -1060);
  EXPECT_EQ(read({.level = -1040}).whole[0], -1041);
  EXPECT_EQ(read({.is_outside_high = true, .level = 2}).whole[0], 3);
  EXPECT_EQ(read({.is_outside_high = true, .level = 12}).whole[0], 22);
  files_.clear();
  file[padding_limit] = {"SS", little(0xfff8, 2)};
  put(file);
  EXPECT_EQ(read({.outside = 40}).whole, (std::vector<int16_t>{40, 0, 2, 40}));
}

TEST_F(Dicom, LocalizersAndCapturesAreSetAside) {
  put(slice(0, {1, 2}));
  Elements localizer = slice(1, {3, 4}), capture = slice(2, {3, 4});
  localizer[image_type] = {"CS", "ORIGINAL\\PRIMARY\\LOCALIZER"};
  capture[sop_class].second = "1.2.840.10008.5.1.4.1.1.7";
  capture[series_uid].second = "1.2.3.10";
  put(localizer);
  put(capture);
  const Series series = read();
  EXPECT_EQ(series.count[2], 1);
  ASSERT_EQ(series.warnings.size(), 1U);
  EXPECT_EQ(series.warnings[0], "the scan \"scan\" holds 1 localizer and 1 secondary capture, which are left out");
}

// Positions in tenths of a millimetre, of slices 0.63 mm apart.
TEST_F(Dicom, StepsMayDifferByRounding) {
  for (const double height : {0.0, 0.6, 1.3, 1.9, 2.5}) put(slice(height, {1, 2}));
  EXPECT_EQ(read().count[2], 5);
}

TEST_F(Dicom, SlicesThatJumpSidewaysAreAnError) {
  for (const double height : {0, 1, 2, 3}) {
    Elements file = slice(height, {1, 2});
    if (height == 2) file[position].second = "-10\\22\\2";
    put(file);
  }
  EXPECT_NE(failure().find("jump sideways: \"" + files_[2] + "\" lies 2 mm beside the line"), std::string::npos)
      << failure();
}

TEST_F(Dicom, UnevenSlicesAreResampledOnRequest) {
  for (const double height : {0, 1, 2, 4})
    put(slice(height, {static_cast<int16_t>(512 + 10 * height), 512}));  // 20 times the height
  EXPECT_NE(failure().find("write regular=true"), std::string::npos);
  const Series series = read({.is_regular = true});
  EXPECT_EQ(series.whole, (std::vector<int16_t>{0, 0, 20, 0, 40, 0, 60, 0, 80, 0}));
  ASSERT_EQ(series.warnings.size(), 1U);
  EXPECT_NE(series.warnings[0].find("4 slices are resampled to 5, 1 mm apart"), std::string::npos);
}

// Part 3, C.8.20.2: one bit a pixel, the first pixel in the lowest bit; here 8 pixels a frame.
TEST_F(Dicom, SegmentationsAreMapsOfLabels) {
  Elements file = enhanced({group(6, "1", 2), group(2, "1", 1)}, {});
  file[sop_class].second = "1.2.840.10008.5.1.4.1.1.66.4";
  file[segmentation_type] = {"CS", "BINARY"};
  file[columns] = number(8);
  file[bits_allocated] = file[bits_stored] = number(1);
  file[high_bit] = file[is_signed] = number(0);
  file[pixels] = {"OB", "\x81\x06"};
  file[segments] = sequence({{{{0x0062, 0x0004}, number(1)}, {{0x0062, 0x0005}, {"LO", "bone"}}},
                             {{{0x0062, 0x0004}, number(2)},
                              {{0x0062, 0x0005}, {"LO", "skin"}},
                              {{0x0062, 0x000d}, {"US", little(65535, 2) + little(32896, 2) + little(32896, 2)}}}});
  put(file);
  const Series series = read();  // the slice between has no frame
  EXPECT_EQ(series.count, (std::array<int64_t, 3>{8, 1, 3}));
  EXPECT_EQ(series.whole,
            (std::vector<int16_t>{0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 2}));
  const auto named = read_segments("scan", files_[0], file_of(file));
  ASSERT_EQ(named.size(), 2U);
  EXPECT_EQ(named[0].name, "bone");
  EXPECT_FALSE(named[0].colour);
  EXPECT_EQ(named[1].label, 2);
  ASSERT_TRUE(named[1].colour);
  for (const double channel : *named[1].colour) EXPECT_NEAR(channel, 1, 0.01);  // L* = 100 is white
  EXPECT_TRUE(read_segments("scan", files_[0], file_of(slice(0, {1, 2}))).empty());
}

TEST_F(Dicom, SegmentsThatOverlapAreAnError) {
  Elements file = enhanced({group(2, "1", 2), group(2, "1", 1)}, {});
  file[sop_class].second = "1.2.840.10008.5.1.4.1.1.66.4";
  file[columns] = number(8);
  file[bits_allocated] = file[bits_stored] = number(1);
  file[high_bit] = file[is_signed] = number(0);
  file[pixels] = {"OB", "\x81\x01"};
  put(file);
  EXPECT_NE(failure().find("has segments that overlap"), std::string::npos) << failure();
  EXPECT_EQ(read({.label = 1}).whole, (std::vector<int16_t>{1, 0, 0, 0, 0, 0, 0, 0}));
}

TEST_F(Dicom, TornEnhancedFilesAreErrors) {
  const std::string whole = file_of(enhanced({group(0), group(1)}, {1, 2, 3, 4}));
  for (size_t size = 140; size < whole.size(); size += 37) {
    files_.clear();
    put(whole.substr(0, size));
    EXPECT_NE(failure(), "") << size;
  }
}

}  // namespace ombre::dicom
