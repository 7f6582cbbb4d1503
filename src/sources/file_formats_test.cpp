#include "sources/file_formats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/text/text.h"

namespace ombre::sources {
namespace {

TEST(FileFormats, HaveEndingsOfTheirOwn) {
  std::set<std::pair<Content, std::string_view>> seen;
  for (const FileFormat& format : file_formats()) {
    EXPECT_FALSE(format.endings.empty()) << format.name;
    EXPECT_TRUE(format.is_read || format.is_written) << format.name;
    for (const std::string_view ending : format.endings) {
      EXPECT_TRUE(ending.starts_with('.') && to_lower(ending) == ending) << ending;
      EXPECT_TRUE(seen.insert({format.content, ending}).second) << ending;
    }
  }
  EXPECT_TRUE(std::ranges::is_sorted(file_formats(), {}, &FileFormat::content));
}

TEST(FileFormats, SayWhatAFileIsReadAs) {
  for (const char* scan :
       {"a.nrrd", "a.NII.GZ", "a.vdb", "a.raw", "a.hdr", "a.dcm", "a.tif", "a.mha", "a.vti", "a.npy"})
    EXPECT_TRUE(is_read_as(scan, Content::volume)) << scan;
  for (const char* other : {"a.nvdb", "a.png", "a.stl", "nrrd", "a.gz"})
    EXPECT_FALSE(is_read_as(other, Content::volume)) << other;
  EXPECT_TRUE(is_read_as("a.vtu", Content::results));
  EXPECT_FALSE(is_read_as("a.inp", Content::results));
  EXPECT_TRUE(is_read_as("a.csv", Content::table));
  EXPECT_TRUE(is_read_as("a.step", Content::cad));
  EXPECT_FALSE(is_read_as("a.cli", Content::outlines));
}

}  // namespace
}  // namespace ombre::sources
