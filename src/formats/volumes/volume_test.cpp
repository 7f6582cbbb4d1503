#include "formats/volumes/volume.h"

#include <gtest/gtest.h>

#include <cstring>

#include "base/text/error.h"
#include "base/text/test_errors.h"
#include "formats/containers/gzip.h"
#include "formats/volumes/npy.h"
#include "formats/volumes/nrrd.h"
#include "formats/volumes/test_bytes.h"

namespace ombre::formats {
namespace {

std::string nrrd_with(const std::string& type, const std::string& more, const std::string& data) {
  return "NRRD0004\ntype: " + type + "\ndimension: 3\nsizes: 2 3 1\n" + more + "\n\n" + data;
}

VoxelVolume read_whole(std::string_view bytes, const std::string* companion = nullptr, int channel = -1) {
  const std::string_view rest = companion ? std::string_view(*companion) : std::string_view();
  return read_volume({"v", bytes, companion ? &rest : nullptr, {"", channel}});
}

std::string volume_problem(const std::string& bytes, const std::string* companion = nullptr) {
  return failure_of([&] { read_whole(bytes, companion); });
}

// Returns what is wrong with a description that has this member besides those that it needs.
std::string description_problem(const std::string& member) {
  const std::string json = R"({"data_type": "uint8", "dimensions": [2, 3, 1], )" + member + "}";
  const std::string problem = volume_problem("123456", &json),
                    start = "the volume \"v\" has a wrong description: v.json:1:";
  return problem.starts_with(start) ? problem.substr(start.size()) : problem;
}

bool is_about(const std::string& problem, const std::string& words) { return problem.find(words) != std::string::npos; }

const std::vector<int16_t> six{-2, 0, 300, 4, 5, 32767};

}  // namespace

TEST(Volume, ReadsWhatNrrdHeadersOfOursSay) {
  const NrrdHeader header{
      .type = "float", .count = {2, 3, 1}, .spacing_mm = {0.5, 0.25, 3}, .origin_mm = {-1, 2, 7}, .notes = {}};
  const std::vector<float> numbers{0, 1.5f, -2, 3, 4, 5};
  const VoxelVolume volume = read_whole(nrrd_header(header) + bytes_of_numbers(numbers));
  EXPECT_EQ(volume.count, (std::array<int64_t, 3>{2, 3, 1}));
  EXPECT_EQ(std::get<std::vector<float>>(volume.values), numbers);
  ASSERT_TRUE(volume.space_from_index);
  EXPECT_EQ((*volume.space_from_index)({1, 2, 1}), (Vec3{-0.5, 2.5, 10}));
  EXPECT_EQ(volume.space, VolumeSpace::right_handed);
}

TEST(Volume, ByteOrdersAndEncodingsGiveTheSameNumbers) {
  std::string swapped = bytes_of_numbers(six), text;
  for (size_t n = 0; n < swapped.size(); n += 2) std::swap(swapped[n], swapped[n + 1]);
  for (const int16_t number : six) text += std::to_string(number) + "\n";
  GzipWriter packer(2, 4);
  const std::string raw = bytes_of_numbers(six);
  packer.add(reinterpret_cast<const uint8_t*>(raw.data()), raw.size());
  packer.finish();
  for (const std::string& file :
       {nrrd_with("short", "endian: little\nencoding: raw", raw),
        nrrd_with("int16", "endian: big\nencoding: raw", swapped), nrrd_with("signed short", "encoding: ascii", text),
        nrrd_with("short", "endian: little\nencoding: gzip", packer.take())}) {
    const VoxelVolume volume = read_whole(file);
    EXPECT_EQ(std::get<std::vector<int16_t>>(volume.values), six);
    EXPECT_FALSE(volume.space_from_index);
  }
}

TEST(Volume, SpacesAndUnitsAreThoseOfTheFile) {
  const std::string header =
      "encoding: ascii\nspace: left-posterior-superior\nspace units: \"cm\" \"cm\" \"cm\"\n"
      "space directions: (0,-2,0) (1,0,0) (0,0,0.5)\nspace origin: (1,2,3)";
  const VoxelVolume volume = read_whole(nrrd_with("float", header, "1 2 3 4 5 6"));
  EXPECT_EQ(volume.space, VolumeSpace::lps);
  EXPECT_EQ((*volume.space_from_index)({1, 0, 0}), (Vec3{10, 0, 30}));
  EXPECT_EQ((*volume.space_from_index)({0, 1, 2}), (Vec3{20, 20, 40}));
}

// The keys are those of 3D Slicer 5, and those before version 4.11, when each segment had its own layer.
TEST(Volume, SegmentsHaveNamesNumbersAndColours) {
  const std::string both = "encoding: ascii\nSegment0_ID:=S_1\nSegment0_Name:=left\\\\right\\n lung\n";
  const auto segments = segments_of(
      "v",
      nrrd_with("uint8", both + "Segment0_LabelValue:=3\nSegment0_Layer:=1\nSegment0_Color:=0.5 0 1\nSegment1_ID:=S_2",
                ""));
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].name, "left\\right\n lung");
  EXPECT_EQ(segments[0].id, "S_1");
  EXPECT_EQ(segments[0].label, 3);
  EXPECT_EQ(segments[0].layer, 1);
  EXPECT_EQ(segments[0].colour, (std::array<double, 3>{0.5, 0, 1}));
  EXPECT_EQ(segments[1].name, "S_2");
  EXPECT_EQ(segments[1].label, 1);
  EXPECT_EQ(segments[1].layer, 1);
  EXPECT_FALSE(segments[1].colour);
  EXPECT_TRUE(segments_of("v", nrrd_with("uint8", "encoding: ascii", "1 2 3 4 5 6")).empty());
  EXPECT_TRUE(segments_of("v", "\x93NUMPY").empty());
  for (const auto& [key, value] : {std::pair{"LabelValue", "-1"}, {"LabelValue", "1.5"}, {"Layer", "-1"}})
    EXPECT_THROW(segments_of("v", nrrd_with("uint8", both + "Segment0_" + key + ":=" + value, "")), Error) << key;
  for (const char* colour : {"1 1", "0 0 255", "red"})
    EXPECT_FALSE(segments_of("v", nrrd_with("uint8", both + "Segment0_Color:=" + colour, ""))[0].colour) << colour;
}

TEST(Volume, NumbersMayLieBesideTheHeader) {
  const std::string header = nrrd_with("uint8", "encoding: raw\nbyte skip: -1\ndata file: numbers.raw", "");
  EXPECT_EQ(companion_of("folder/v.nhdr", header), "folder/numbers.raw");
  const std::string data = "xxx123456";
  EXPECT_EQ(std::get<std::vector<uint8_t>>(read_whole(header, &data).values)[0], '1');
  EXPECT_TRUE(is_about(volume_problem(header), "numbers.raw, which is not there"));
}

// In both orders a[k, j, i] is voxel (i, j, k).
TEST(Volume, NpyArraysHaveTheShapeZyx) {
  const std::string header = npy_header("<i2", {1, 3, 2});
  const VoxelVolume c = read_whole(header + bytes_of_numbers(six));
  EXPECT_EQ(c.count, (std::array<int64_t, 3>{2, 3, 1}));
  EXPECT_EQ(std::get<std::vector<int16_t>>(c.values), six);
  std::string fortran = header;
  fortran.replace(fortran.find("False"), 5, "True ");
  const std::vector<int16_t> by_columns{-2, 300, 5, 0, 4, 32767};
  EXPECT_EQ(std::get<std::vector<int16_t>>(read_whole(fortran + bytes_of_numbers(by_columns)).values), six);
}

TEST(Volume, DescriptionsSayWhatNumbersAre) {
  const std::string json = R"({"data_type": "int16", "byte_order": "little", "header_bytes": 3, "dimensions": [2, 3, 1],
                               "spacing_mm": [1, 2, 3], "origin_mm": [4, 5, 6], "space": "RAS"})";
  const VoxelVolume volume = read_whole("abc" + bytes_of_numbers(six), &json);
  EXPECT_EQ(std::get<std::vector<int16_t>>(volume.values), six);
  EXPECT_EQ((*volume.space_from_index)({1, 1, 1}), (Vec3{5, 7, 9}));
  EXPECT_EQ(volume.space, VolumeSpace::ras);
  EXPECT_EQ(companion_of("v.raw", "abc"), "v.raw.json");
  EXPECT_TRUE(is_about(volume_problem("abcd", &json), "cut off"));
  EXPECT_TRUE(is_about(volume_problem(std::string(99, 'a'), &json), "99 bytes") ||
              is_about(volume_problem(std::string(99, 'a'), &json), "96 bytes"));
}

TEST(Volume, WrongDescriptionsSayWhatIsWrongAndWhere) {
  EXPECT_EQ(description_problem(R"("byte_order": "middle")"),
            R"(64: there is no byte_order "middle"; write one of "little", "big")");
  EXPECT_EQ(description_problem(R"("header_bytes": -1)"),
            R"(65: expected a whole number from 0 to 1000000000000000 for "header_bytes", not -1)");
  EXPECT_EQ(description_problem(R"("channels": 0)"),
            R"(61: expected a whole number from 1 to 1000 for "channels", not 0)");
  EXPECT_EQ(description_problem(R"("axes": ["z", "y", "x"])"),
            R"(57: expected ["x","y","z"] for "axes", not a list of 3)");
  EXPECT_EQ(description_problem(R"("fastest_axis": "z")"), R"(66: expected "x" for "fastest_axis", not the text "z")");
  EXPECT_EQ(description_problem(R"("space": "xyz")"),
            R"(59: expected "RAS", "LPS" or "LAS" for "space", not the text "xyz")");
  EXPECT_EQ(description_problem(R"("spacing_mm": [1, 0, 1])"),
            R"(67: expected a number above 0 for "spacing_mm", not 0)");
  EXPECT_EQ(description_problem(R"("spacing_mm": [1, 1, 1], "origin_mm": 3)"),
            R"(87: expected 3 numbers for "origin_mm", not 3; write [x, y, z] in mm)");
  EXPECT_EQ(description_problem(R"("spacing": [1, 1, 1])"),
            R"(60: a description of numbers has no "spacing"; did you mean "spacing_mm"?)");
  EXPECT_EQ(description_problem(R"("made by": "us", "values": "density", "file": "v.raw")"), "no error");
  EXPECT_TRUE(is_about(description_problem("1"), "this is not valid JSON"));
}

TEST(Volume, WrongFilesSayWhatIsWrong) {
  EXPECT_TRUE(is_about(volume_problem("hello"), "none of NRRD, NIfTI, MetaImage, VTI and NPY"));
  EXPECT_TRUE(is_about(volume_problem(nrrd_with("short", "endian: little\nencoding: raw", "abc")), "cut off"));
  EXPECT_TRUE(is_about(volume_problem(nrrd_with("short", "encoding: raw", "abc")), "without \"endian\""));
  EXPECT_TRUE(is_about(volume_problem(nrrd_with("float", "encoding: ascii", "1 2 nan 4 5 6")),
                       "has 1 value that is NaN, no number, the first at voxel (0, 1, 0); nan=0"));
  EXPECT_TRUE(is_about(volume_problem(nrrd_with("uint8", "encoding: ascii", "1 2 3 4 5 256")), "cannot hold"));
  EXPECT_TRUE(is_about(volume_problem(nrrd_with("uint8", "encoding: bzip2", "")), "raw, gzip or ascii"));
  EXPECT_TRUE(is_about(volume_problem(nrrd_with("block", "encoding: raw", "")), "type \"block\""));
  EXPECT_TRUE(
      is_about(volume_problem(nrrd_with("uint8", "encoding: raw\nspacings: 1 -1 1", "abcdef")), "must be positive"));
  EXPECT_TRUE(
      is_about(volume_problem(nrrd_with("uint8", "encoding: raw\nspacings: 1 1e300 1", "abcdef")), "voxels of"));
  EXPECT_TRUE(
      is_about(volume_problem(nrrd_with("uint8", "encoding: raw\nspace directions: (1,0,0) (1,0,0) (0,0,1)", "abcdef")),
               "one plane"));
  EXPECT_TRUE(is_about(volume_problem(nrrd_with("uint8",
                                                "encoding: raw\nspace units: \"foot\"\nspace directions: (1,0,0) "
                                                "(0,1,0) (0,0,1)",
                                                "abcdef")),
                       "foot"));
  EXPECT_TRUE(is_about(volume_problem(npy_header("<c8", {1, 3, 2})), "astype"));
  EXPECT_TRUE(is_about(volume_problem(npy_header("<i2", {3, 2})), "2 axes"));
}

// The errors occur before memory is allocated.
TEST(Volume, SizesThatCannotBeAreErrors) {
  EXPECT_TRUE(is_about(volume_problem(npy_header("<f8", {1 << 20, 1 << 20, 1 << 20})), "more than 1 TiB"));
  EXPECT_TRUE(is_about(volume_problem(npy_header("<f8", {1 << 10, 1 << 10, 1 << 10})), "cut off"));
  const std::string huge = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2000 2000 2000\nencoding: gzip\n\n";
  EXPECT_TRUE(is_about(volume_problem(huge + "abc"), "too short"));
  EXPECT_TRUE(is_about(volume_problem(npy_header("|u1", {0, 2, 2})), "axis of 0"));
}

}  // namespace ombre::formats
