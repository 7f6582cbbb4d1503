// Tests of the numbers of volumes: 64-bit integers, NaN, and bytes behind them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "base/text/error.h"
#include "base/text/test_errors.h"
#include "formats/containers/gzip.h"
#include "formats/volumes/npy.h"
#include "formats/volumes/test_bytes.h"
#include "formats/volumes/volume.h"

namespace ombre::formats {
namespace {

std::string nrrd(const std::string& type, const std::string& more, const std::string& data) {
  return "NRRD0005\ntype: " + type + "\ndimension: 3\nsizes: 2 2 1\nendian: little\n" + more + "\n\n" + data;
}

VoxelVolume read(const std::string& bytes, std::optional<double> nan = {}) {
  VolumeChoice choice;
  choice.nan = nan;
  return read_volume({"v", bytes, nullptr, choice});
}

std::string problem(const std::string& bytes) {
  return failure_of([&] { read(bytes); });
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

std::string packed(const std::string& bytes) {
  GzipWriter packer(bytes.size(), 4);
  packer.add(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  packer.finish();
  return packer.take();
}

// A NIfTI-1 header of 2 x 2 x 1 voxels as nifti1.h lays it out; numbers follow at byte 352.
std::string nifti(int16_t type, int16_t bits, float slope, float intercept, const std::string& data) {
  std::string header(352, '\0');
  const auto put = [&](size_t at, auto value) { std::memcpy(header.data() + at, &value, sizeof value); };
  put(0, int32_t{348});
  const int16_t sizes[] = {3, 2, 2, 1, 1, 1, 1, 1};
  for (size_t n = 0; n < 8; ++n) put(40 + 2 * n, sizes[n]);
  put(70, type);
  put(72, bits);
  for (size_t n = 0; n < 4; ++n) put(76 + 4 * n, 1.0F);
  put(108, 352.0F);
  put(112, slope);
  put(116, intercept);
  std::memcpy(header.data() + 344, "n+1", 3);
  return header + data;
}

constexpr float no_number = std::numeric_limits<float>::quiet_NaN();
const std::vector<int64_t> long_numbers{-2, 0, 7, 2147483647};

}  // namespace

TEST(VolumeNumbers, LongIntegersAreRead) {
  const std::vector<int32_t> wanted{-2, 0, 7, 2147483647};
  std::string vti =
      R"(<VTKFile type="ImageData" byte_order="LittleEndian"><ImageData WholeExtent="0 1 0 1 0 0"><Piece Extent="0 1 0 1 0 0">)"
      R"(<PointData><DataArray type="Int64" Name="a" format="ascii">-2 0 7 2147483647</DataArray></PointData></Piece>)"
      R"(</ImageData></VTKFile>)";
  const std::string mha =
      "ObjectType = Image\nNDims = 3\nDimSize = 2 2 1\nElementType = MET_LONG_LONG\nElementDataFile = LOCAL\n";
  for (const std::string& file :
       {nrrd("int64", "encoding: raw", bytes_of_numbers(long_numbers)),
        nrrd("long long int", "encoding: ascii", "-2 0 7 2147483647"),
        npy_header("<i8", {1, 2, 2}) + bytes_of_numbers(long_numbers),
        nifti(1024, 64, 0, 0, bytes_of_numbers(long_numbers)), mha + bytes_of_numbers(long_numbers)
#ifdef OMBRE_3MF
                                                                   ,
        vti
#endif
       }) {
    const VoxelVolume volume = read(file);
    EXPECT_EQ(std::get<std::vector<int32_t>>(volume.values), wanted);
    EXPECT_EQ(volume.type, "int64");
  }
}

// A double holds every whole number up to 2^53.
TEST(VolumeNumbers, LongIntegersAreExactOrAnError) {
  const int64_t most = int64_t{1} << 53;
  const VoxelVolume exact =
      read(nrrd("int64", "encoding: raw", bytes_of_numbers(std::vector<int64_t>{most, -most, most - 1, 0})));
  EXPECT_EQ(std::get<std::vector<double>>(exact.values), (std::vector<double>{0x1p53, -0x1p53, 0x1p53 - 1, 0}));
  EXPECT_TRUE(has(problem(nrrd("int64", "encoding: raw", bytes_of_numbers(std::vector<int64_t>{0, 0, most + 1, 0}))),
                  "has the int64 9007199254740993 at voxel (0, 1, 0), which is beyond 2^53"));
  EXPECT_TRUE(
      has(problem(nrrd("uint64", "encoding: raw", bytes_of_numbers(std::vector<uint64_t>{~uint64_t{0}, 0, 0, 0}))),
          "has the uint64 18446744073709551615 at voxel (0, 0, 0)"));
}

TEST(VolumeNumbers, NanIsAnErrorOrReplaced) {
  const std::string file =
      nrrd("float", "encoding: raw", bytes_of_numbers(std::vector<float>{1, no_number, no_number, 4}));
  EXPECT_TRUE(has(problem(file), "has 2 values that are NaN, no number, the first at voxel (1, 0, 0); nan=0"));
  EXPECT_EQ(std::get<std::vector<float>>(read(file, -5).values), (std::vector<float>{1, -5, -5, 4}));
  const std::string infinite = nrrd(
      "float", "encoding: raw", bytes_of_numbers(std::vector<float>{1, 2, std::numeric_limits<float>::infinity(), 4}));
  EXPECT_TRUE(has(problem(infinite), "has 1 value that is infinite, the first at voxel (0, 1, 0)"));
}

// The number in place of NaN is that of the design, so the file's scale does not change it.
TEST(VolumeNumbers, NiftiScalesNumbersAlone) {
  const std::string data = bytes_of_numbers(std::vector<float>{1, no_number, 3, 4});
  EXPECT_EQ(std::get<std::vector<float>>(read(nifti(16, 32, 2, 10, data), 7).values),
            (std::vector<float>{12, 7, 16, 18}));
}

// nibabel takes a slope that is not finite as none; a scale whose intercept is unknown cannot be applied.
TEST(VolumeNumbers, NiftiSlopesOfNanMeanNoScale) {
  const std::string data = bytes_of_numbers(std::vector<int16_t>{1, 2, 3, 4});
  EXPECT_EQ(std::get<std::vector<int16_t>>(read(nifti(4, 16, no_number, no_number, data)).values)[3], 4);
  EXPECT_TRUE(has(problem(nifti(4, 16, 2, no_number, data)), "intercept is not finite"));
}

TEST(VolumeNumbers, BytesBehindNumbersAreAWarning) {
  const std::string data = bytes_of_numbers(std::vector<int16_t>{1, 2, 3, 4}), file = nifti(4, 16, 0, 0, data);
  EXPECT_TRUE(read(file).warnings.empty());
  const VoxelVolume longer = read(file + "abc");
  ASSERT_EQ(longer.warnings.size(), 1U);
  EXPECT_TRUE(has(longer.warnings[0], "3 bytes behind its numbers"));
  EXPECT_TRUE(read(packed(file) + std::string(512, '\0')).warnings.empty());
  const VoxelVolume behind = read(packed(file) + "abc");
  ASSERT_EQ(behind.warnings.size(), 1U);
  EXPECT_TRUE(has(behind.warnings[0], "3 bytes behind its packed contents"));
  EXPECT_EQ(std::get<std::vector<int16_t>>(behind.values)[2], 3);
}

TEST(VolumeNumbers, ShortPackedFilesAreErrors) {
  for (const char* bytes : {"\x1F\x8B", "\x1F\x8B\x08", "\x1F\x8B\x08zzzzzzzz"})
    EXPECT_TRUE(has(problem(bytes), "damaged or cut off")) << problem(bytes);
}

TEST(VolumeNumbers, NrrdDirectionsOfNanAreUnknown) {
  const std::string nans = "(nan,nan,nan) ", data = "abcd";
  const VoxelVolume unknown =
      read(nrrd("uint8", "encoding: raw\nspace: LPS\nspace directions: " + nans + nans + "(NaN,NaN,NaN)", data));
  EXPECT_FALSE(unknown.space_from_index);
  const VoxelVolume no_origin = read(nrrd(
      "uint8", "encoding: raw\nspace: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: " + nans, data));
  ASSERT_TRUE(no_origin.space_from_index);
  EXPECT_EQ(no_origin.space_from_index->offset, (Vec3{0, 0, 0}));
  EXPECT_EQ(no_origin.warnings.size(), 1U);
  const std::string vectors =
      "NRRD0005\ntype: uint8\ndimension: 4\nsizes: 2 2 2 1\nencoding: raw\nspace: LPS\n"
      "space directions: (nan,nan,nan) (1,0,0) (0,1,0) (0,0,1)\n\n01234567";
  VolumeChoice second;
  second.channel = 1;
  EXPECT_EQ(std::get<std::vector<uint8_t>>(read_volume({"v", vectors, nullptr, second}).values),
            (std::vector<uint8_t>{'1', '3', '5', '7'}));
}

#ifdef OMBRE_3MF
// VTK's defaults are a spacing of 1 and an origin of 0.
TEST(VolumeNumbers, VtiWithoutSpacingHasThatOfVtk) {
  const VoxelVolume volume = read(
      R"(<VTKFile type="ImageData"><ImageData WholeExtent="3 4 0 1 0 0"><Piece Extent="3 4 0 1 0 0"><PointData>)"
      R"(<DataArray type="UInt8" Name="a" format="ascii">1 2 3 4</DataArray></PointData></Piece></ImageData></VTKFile>)");
  ASSERT_TRUE(volume.space_from_index);
  EXPECT_EQ((*volume.space_from_index)({0, 0, 0}), (Vec3{3, 0, 0}));
  EXPECT_EQ((*volume.space_from_index)({1, 1, 1}), (Vec3{4, 1, 1}));
}

TEST(VolumeNumbers, VtiMayHaveAByteOrderMarkAndWords) {
  const VoxelVolume volume = read(
      "\xEF\xBB\xBF"
      R"(<VTKFile type="ImageData"><ImageData WholeExtent="0 1 0 0 0 0"><Piece Extent="0 1 0 0 0 0"><PointData>)"
      R"(<DataArray type="String" Name="who" NumberOfTuples="1" format="ascii">65 0</DataArray>)"
      R"(<DataArray type="UInt8" Name="a" format="ascii">1 2</DataArray></PointData></Piece></ImageData></VTKFile>)");
  EXPECT_EQ(std::get<std::vector<uint8_t>>(volume.values), (std::vector<uint8_t>{1, 2}));
}
#endif

}  // namespace ombre::formats
