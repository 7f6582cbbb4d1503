// Tests of voxel grids, whose headers are read as the formats define them.
#include "export/volume_file.h"

#include <gtest/gtest.h>

#include "base/text/json.h"
#include "export/test_folder.h"
#include "formats/containers/file.h"
#include "formats/volumes/volume_packing.h"

namespace ombre::exporting {
namespace {

using VoxelGrids = FolderTest;

Volume small_volume(bool is_float) {
  Volume volume;
  volume.is_float = is_float;
  volume.count = {3, 2, 4};
  volume.spacing_mm = {0.5, 0.25, 1};
  volume.origin_mm = {-1, 0, 2.5};
  volume.about = {{"unit", "mm"}, {"materials", DataList{"red", "blue"}}};
  return volume;
}

std::string counted(size_t bytes) {
  std::string numbers;
  for (size_t n = 0; n < bytes; ++n) numbers += static_cast<char>(7 * n);
  return numbers;
}

// Writes the numbers in pieces and returns the file.
std::string written(const std::string& path, std::string_view ending, const Volume& volume, size_t piece,
                    bool is_gzip = false) {
  VolumeFile file(path, volume_format(ending), volume, is_gzip);
  const std::string numbers = counted(volume.bytes());
  for (size_t n = 0; n < numbers.size(); n += piece) file.append(std::string_view(numbers).substr(n, piece));
  file.close();
  file.commit();
  const std::string bytes = formats::read_file(path);
  EXPECT_EQ(file.bytes_written(), bytes.size());
  return bytes;
}

Data json_in(const std::string& path) {
  Diagnostics diagnostics;
  const auto data = parse_json(make_source(path, formats::read_file(path)), diagnostics);
  EXPECT_TRUE(data);
  return data.value_or(Data());
}

std::vector<double> numbers_of(const Data& object, std::string_view key) {
  std::vector<double> numbers;
  for (const Data& number : *object.find(key)->list()) numbers.push_back(*number.number());
  return numbers;
}

}  // namespace

TEST_F(VoxelGrids, OfPlainNumbersAreDescribedBeside) {
  const Volume volume = small_volume(true);
  EXPECT_EQ(written(path("a.raw"), ".raw", volume, 40), counted(4 * 24));
  EXPECT_EQ(names(), (std::vector<std::string>{"a.raw", "a.raw.json"}));
  const Data about = json_in(description_path(path("a.raw")));
  EXPECT_EQ(*about.find("file")->string(), "a.raw");
  EXPECT_EQ(*about.find("data_type")->string(), "float32");
  EXPECT_EQ(*about.find("header_bytes")->number(), 0);
  EXPECT_EQ(numbers_of(about, "dimensions"), (std::vector<double>{3, 2, 4}));
  EXPECT_EQ(numbers_of(about, "spacing_mm"), (std::vector<double>{0.5, 0.25, 1}));
  EXPECT_EQ(numbers_of(about, "origin_mm"), (std::vector<double>{-1, 0, 2.5}));
  EXPECT_EQ(*about.find("unit")->string(), "mm");
}

// NumPy's format 1.0: the bytes 8 and 9 hold the length of the header, and the numbers follow it.
TEST_F(VoxelGrids, ForNumPySayWhereTheirNumbersBegin) {
  for (const bool is_float : {false, true}) {
    const Volume volume = small_volume(is_float);
    const std::string bytes = written(path("a.npy"), ".npy", volume, 24);
    ASSERT_TRUE(bytes.starts_with("\x93NUMPY\x01"));
    const size_t header = 10 + static_cast<uint8_t>(bytes[8]) + 256U * static_cast<uint8_t>(bytes[9]);
    EXPECT_EQ(bytes.substr(header), counted(volume.bytes()));
    EXPECT_NE(bytes.find(is_float ? "'<f4'" : "'|u1'"), std::string::npos);
    EXPECT_NE(bytes.find("(4, 2, 3"), std::string::npos);
    EXPECT_EQ(*json_in(path("a.npy.json")).find("header_bytes")->number(), static_cast<double>(header));
  }
}

// NRRD: an empty line ends the header.
TEST_F(VoxelGrids, OfNrrdHoldTheirDescription) {
  const Volume volume = small_volume(false);
  for (const bool is_gzip : {false, true}) {
    const std::string bytes = written(path("a.nrrd"), ".nrrd", volume, 6, is_gzip);
    EXPECT_EQ(names(), std::vector<std::string>{"a.nrrd"});
    const size_t end = bytes.find("\n\n");
    ASSERT_NE(end, std::string::npos);
    const std::string header = bytes.substr(0, end + 1), numbers = bytes.substr(end + 2);
    EXPECT_TRUE(header.starts_with("NRRD000"));
    EXPECT_NE(header.find("\nsizes: 3 2 4\n"), std::string::npos);
    EXPECT_NE(header.find("\nunit:=mm\n"), std::string::npos);
    EXPECT_NE(header.find("\nmaterials:=[\"red\""), std::string::npos);
    EXPECT_NE(header.find(is_gzip ? "\nencoding: gzip\n" : "\nencoding: raw\n"), std::string::npos);
    EXPECT_EQ(is_gzip ? formats::unpacked("a.nrrd", numbers, formats::Packing::gzip, 24) : numbers, counted(24));
  }
}

TEST_F(VoxelGrids, DoNotDependOnThePieces) {
  for (const VolumeFormat& format : volume_formats())
    for (const bool is_gzip : {false, format.can_compress})
      for (const size_t piece : {24U, 48U})
        EXPECT_EQ(written(path("a"), format.ending, small_volume(true), piece, is_gzip),
                  written(path("a"), format.ending, small_volume(true), 96, is_gzip));
}

TEST_F(VoxelGrids, AreNotThereUnlessTheyAreCommitted) {
  put("a.raw", "before");
  { VolumeFile(path("a.raw"), volume_format(".raw"), small_volume(true)).append(counted(96)); }
  EXPECT_EQ(names(), std::vector<std::string>{"a.raw"});
  fill_disk_of("a.raw.json");
  EXPECT_NE(failure_of([&] {
              VolumeFile(path("a.raw"), volume_format(".raw"), small_volume(true));
            }).find("cannot write " + path("a.raw.json") + ": No space left on device"),
            std::string::npos);
  EXPECT_EQ(names(), std::vector<std::string>{"a.raw"});
  EXPECT_EQ(formats::read_file(path("a.raw")), "before");
}

}  // namespace ombre::exporting
