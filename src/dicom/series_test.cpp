// Tests of series of DICOM files.
#include "dicom/series.h"

#include "dicom/test_dicom_files.h"

namespace ombre::dicom {
namespace {

void expect_near(Vec3 a, Vec3 b) { EXPECT_LT(length(a - b), 1e-9) << a.x << " " << a.y << " " << a.z; }

}  // namespace

TEST(DicomFiles, AreKnownByTheirFirstBytes) {
  EXPECT_TRUE(is_dicom(file_of({})));
  EXPECT_TRUE(is_dicom(std::string(128, 'x') + "DICM"));
  EXPECT_FALSE(is_dicom("DICM"));
  EXPECT_FALSE(is_dicom(std::string(127, 'x') + "DICM"));
  EXPECT_FALSE(is_dicom(std::string(128, 'x') + "DIC"));
  EXPECT_FALSE(is_dicom(""));
}

// Part 3, C.7.6.2: positions are those of the first pixel's centre. The spacing is first that of rows, then of columns.
TEST_F(Dicom, SlicesLieWhereTheySay) {
  put(slice(7, {3, 4}));
  put(slice(5, {-1, 600}));
  const Series series = read();
  EXPECT_EQ(series.count, (std::array<int64_t, 3>{2, 1, 2}));
  expect_near(series.lps_from_index({0, 0, 0}), {-10, 20, 5});
  expect_near(series.lps_from_index({1, 0, 0}), {-9.75, 20, 5});
  expect_near(series.lps_from_index({0, 1, 0}), {-10, 20.5, 5});
  expect_near(series.lps_from_index({0, 0, 1}), {-10, 20, 7});
  // Hounsfield units are 2 v - 1024.
  EXPECT_EQ(series.whole, (std::vector<int16_t>{-1026, 176, -1018, -1016}));
  EXPECT_TRUE(series.real.empty());
  EXPECT_EQ(series.slope, 2);
  EXPECT_EQ(series.intercept, -1024);
  EXPECT_TRUE(series.warnings.empty());
}

TEST_F(Dicom, NumbersThatAreNotWholeAreReal) {
  Elements elements = slice(0, {1, 3});
  elements[slope].second = "0.5";
  put(elements);
  const Series series = read();
  EXPECT_TRUE(series.whole.empty());
  EXPECT_EQ(series.real, (std::vector<float>{-1023.5F, -1022.5F}));
}

TEST_F(Dicom, NumbersAreAsLargeAsTheirBitsAllow) {
  Elements elements = slice(0, {-1, 1});  // 65535 without a sign
  elements[is_signed] = number(0);
  elements[slope].second = "1";
  elements[intercept].second = "0";
  put(elements);
  EXPECT_EQ(read().real, (std::vector<float>{65535, 1}));
  elements[bits_allocated] = elements[bits_stored] = number(8);
  elements[high_bit] = number(7);
  elements[pixels] = {"OW", "\xff\x01"};
  files_.clear();
  put(elements);
  EXPECT_EQ(read().whole, (std::vector<int16_t>{255, 1}));
}

TEST_F(Dicom, WhatIsNoImageIsPassedOver) {
  put(std::string("a text"));
  put(slice(0, {1, 2}));
  Elements report = slice(3, {1, 2});
  for (const Tag& tag : {rows, columns, pixels}) report.erase(tag);
  put(report);
  files_.push_back((folder_ / "none").string());
  EXPECT_EQ(read().count, (std::array<int64_t, 3>{2, 1, 1}));
}

TEST_F(Dicom, WithoutImagesIsAnError) {
  EXPECT_EQ(failure(), "the scan \"scan\" holds no DICOM images");
  put(std::string("a text"));
  EXPECT_EQ(failure(), "the scan \"scan\" holds no DICOM images");
}

TEST_F(Dicom, OneOfSeveralSeriesIsChosen) {
  put(slice(0, {1, 2}));
  Elements other = slice(0, {512, 513});
  other[series_uid].second = "1.2.3.10";
  other[series_number].second = "5";
  put(other);
  const std::vector<int16_t> wanted{0, 2};
  EXPECT_EQ(read({"5"}).whole, wanted);
  EXPECT_EQ(read({"1.2.3.10"}).whole, wanted);
  EXPECT_EQ(read({"4"}).whole, (std::vector<int16_t>{-1022, -1020}));
  for (const char* part :
       {"holds 2 series: ", "series 4: CT, 1 file of 2 x 1, UID 1.2.3.9", "series 5", "choose one by series=\""})
    EXPECT_NE(failure().find(part), std::string::npos) << part;
  EXPECT_NE(failure({"6"}).find("holds no series \"6\""), std::string::npos);
  other[series_uid].second = "1.2.3.11";
  put(other);
  EXPECT_NE(failure({"5"}).find("holds several series with the number 5"), std::string::npos);
}

TEST_F(Dicom, MissingSlicesAreAnError) {
  for (const double height : {0, 1, 2, 5, 6}) put(slice(height, {1, 2}));
  EXPECT_NE(failure().find("lacks 2 slices between \"" + files_[2] + "\" and \"" + files_[3] + '"'), std::string::npos)
      << failure();
}

TEST_F(Dicom, UnevenSlicesAreAnError) {
  for (const double height : {0.0, 1.0, 2.0, 3.3, 4.3}) put(slice(height, {1, 2}));
  EXPECT_NE(failure().find("has slices at uneven distances: 1.3 mm"), std::string::npos) << failure();
  EXPECT_NE(failure().find("elsewhere 1 mm; write regular=true to resample them linearly"), std::string::npos)
      << failure();
}

TEST_F(Dicom, SlicesThatComeTwiceAreLeftOut) {
  for (const double height : {0, 1, 1, 2}) put(slice(height, {1, 2}));
  const Series series = read();
  EXPECT_EQ(series.count[2], 3);
  ASSERT_EQ(series.warnings.size(), 1U);
  EXPECT_NE(series.warnings[0].find("has 1 slice twice at one place"), std::string::npos);
}

TEST_F(Dicom, SlicesThatDoNotFitAreErrors) {
  const auto with = [&](Tag tag, const std::pair<std::string, std::string>& value) {
    files_.clear();
    put(slice(0, {1, 2}));
    Elements other = slice(1, {1, 2});
    other[tag] = value;
    put(other);
    return failure();
  };
  EXPECT_NE(with(columns, number(1)).find("has slices of different sizes"), std::string::npos);
  EXPECT_NE(with(pixel_spacing, {"DS", "0.5\\0.3"}).find("has slices that lie in different ways"), std::string::npos);
  EXPECT_NE(with(orientation, {"DS", "0\\1\\0\\-1\\0\\0"}).find("has slices that lie in different ways"),
            std::string::npos);
}

TEST_F(Dicom, ColoursAreAnError) {
  Elements colours = slice(0, {1, 2, 3});
  colours[samples] = number(3);
  colours[photometric].second = "RGB";
  colours[{0x0028, 0x0006}] = number(0);  // planar configuration
  colours[bits_allocated] = colours[bits_stored] = number(8);
  colours[high_bit] = number(7);
  colours[is_signed] = number(0);
  put(colours);
  EXPECT_NE(failure().find("has pixels in colour"), std::string::npos) << failure();
}

TEST_F(Dicom, TornFilesAreErrors) {
  const std::string whole = file_of(slice(0, {1, 2}));
  for (const size_t missing : {1U, 2U, 3U, 4U, 8U, 40U, 200U}) {
    files_.clear();
    put(whole.substr(0, whole.size() - missing));
    EXPECT_NE(failure(), "") << missing;
  }
}

TEST_F(Dicom, ReadingStopsOnRequest) {
  put(slice(0, {1, 2}));
  StopFlag stop;
  stop.request();
  EXPECT_THROW(read({}, &stop), Cancelled);
}

}  // namespace ombre::dicom
