// Tests of VTK image data, read as "VTK XML file formats" describes appended raw data: after "_", at the offset of an
// array, eight bytes with the number of bytes, then these.
#include "export/vti_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "export/test_folder.h"
#include "formats/containers/file.h"

namespace ombre::exporting {
namespace {

using VtiGrids = FolderTest;

// Two by three by two voxels with a number and three bytes each.
formats::VtiGrid two_arrays() {
  formats::VtiGrid grid;
  grid.count = {2, 3, 2};
  grid.spacing_mm = {0.5, 0.5, 1};
  grid.arrays = {{"distance", true, {""}}, {"colour", false, {"red", "green", "blue"}}};
  return grid;
}

std::string layers_of(size_t bytes, char first) {
  std::string numbers(bytes, '\0');
  for (size_t n = 0; n < bytes; ++n) numbers[n] = static_cast<char>(first + static_cast<char>(n));
  return numbers;
}

// Returns the numbers of an array as a reader finds them, or "" if its length is not in front of them.
std::string array_in(const std::string& file, const std::string& name, size_t bytes) {
  const size_t data = file.find("<AppendedData encoding=\"raw\">\n_"), tag = file.find("Name=\"" + name + "\"");
  if (data == std::string::npos || tag == std::string::npos) return "";
  const size_t offset = std::stoul(file.substr(file.find("offset=\"", tag) + 8));
  const size_t at = file.find('_', data) + 1 + offset;
  uint64_t length = 0;
  std::memcpy(&length, file.data() + at, sizeof length);
  return length == bytes ? file.substr(at + sizeof length, bytes) : "";
}

}  // namespace

TEST_F(VtiGrids, AreReadBackWhateverTheOrderOfLayers) {
  const std::string distance = layers_of(48, 1), colour = layers_of(36, 64);
  std::string first;
  for (const bool is_backwards : {false, true}) {
    VtiFile file(path("a.vti"), two_arrays());
    for (const int64_t layer : is_backwards ? std::array<int64_t, 2>{1, 0} : std::array<int64_t, 2>{0, 1}) {
      const auto at = static_cast<size_t>(layer);
      file.write(1, layer, colour.substr(18 * at, 18));
      file.write(0, layer, distance.substr(24 * at, 24));
    }
    file.close();
    EXPECT_EQ(names(), (std::vector<std::string>{"a.vti.part"}));
    file.commit();
    const std::string bytes = formats::read_file(path("a.vti"));
    EXPECT_EQ(bytes.size(), file.bytes_written());
    EXPECT_EQ(array_in(bytes, "distance", 48), distance);
    EXPECT_EQ(array_in(bytes, "colour", 36), colour);
    EXPECT_TRUE(bytes.ends_with("\n  </AppendedData>\n</VTKFile>\n"));
    if (is_backwards) {
      EXPECT_EQ(bytes, first);
    }
    first = bytes;
    std::filesystem::remove(path("a.vti"));
  }
}

TEST_F(VtiGrids, TakeSeveralLayersAtOnceAndZerosForTheOthers) {
  const std::string distance = layers_of(48, 1);
  VtiFile file(path("a.vti"), two_arrays());
  file.write(0, 0, distance);
  file.close();
  file.commit();
  const std::string bytes = formats::read_file(path("a.vti"));
  EXPECT_EQ(array_in(bytes, "distance", 48), distance);
  EXPECT_EQ(array_in(bytes, "colour", 36), std::string(36, '\0'));
}

TEST_F(VtiGrids, AreNotThereUnlessTheyAreCommitted) {
  { VtiFile(path("a.vti"), two_arrays()).close(); }
  EXPECT_TRUE(names().empty());
  fill_disk_of("a.vti");
  EXPECT_NE(failure_of([&] { VtiFile(path("a.vti"), two_arrays()); }).find("No space left on device"),
            std::string::npos);
  EXPECT_TRUE(names().empty());
}

}  // namespace ombre::exporting
