// Tests of which files of outlines appear, and when; formats/drawings tests what they hold.
#include "export/outline_files.h"

#include <gtest/gtest.h>

#include "export/test_folder.h"
#include "formats/containers/file.h"

namespace ombre::exporting {
namespace {

using OutlineLayers = FolderTest;
using Names = std::vector<std::string>;
using formats::read_file;

const formats::OutlineDocument square_document{"part", {{0, 0, 0}, {1, 1, 1}}, {{"red", {255, 0, 0, 255}}}};
const formats::OutlinePolygons square{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};

// Begins files with so many layers of 0.5 mm, and adds the first of them.
std::unique_ptr<OutlineFiles> begun(const std::string& path, uint64_t layers, uint64_t added) {
  auto files = begin_outline_files({path, outline_format_of(path), layers, 0}, square_document);
  for (uint64_t n = 0; n < added; ++n) {
    const double bottom = 0.5 * static_cast<double>(n);
    files->add(bottom + 0.25, bottom + 0.5, square);
  }
  return files;
}

size_t count_in(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST(OutlineFormats, FollowTheEnding) {
  EXPECT_EQ(outline_format_of("a/part.cli"), OutlineFormat::cli);
  EXPECT_EQ(outline_format_of("part.CLI"), OutlineFormat::cli);
  EXPECT_EQ(outline_format_of("part.svg"), OutlineFormat::svg);
  for (const char* folder : {"part", "part.cli/layers", "part.svgs", "svg"})
    EXPECT_EQ(outline_format_of(folder), OutlineFormat::svg_folder) << folder;
}

TEST_F(OutlineLayers, AppearOnceTheyAreCommitted) {
  const auto files = begun(path("part"), 3, 3);
  EXPECT_FALSE(has_outline_layers(path("part")));
  files->commit();
  EXPECT_TRUE(has_outline_layers(path("part")));
  EXPECT_EQ(names("part"), (Names{"layer_0000.svg", "layer_0001.svg", "layer_0002.svg"}));
  EXPECT_NE(read_file(path("part/layer_0002.svg")).find("<title>part, z 1.25 mm</title>"), std::string::npos);
}

TEST_F(OutlineLayers, HaveNumbersOfOneLength) {
  begun(path("few"), 10000, 1)->commit();
  EXPECT_EQ(names("few"), Names{"layer_0000.svg"});
  begun(path("many"), 10001, 2)->commit();
  EXPECT_EQ(names("many"), (Names{"layer_00000.svg", "layer_00001.svg"}));
}

TEST_F(OutlineLayers, ReplaceThoseOfAnEarlierRunAlone) {
  std::filesystem::create_directory(path("part"));
  const Names others{"layer_12.svg", "layer_0001.svg.bak", "layer_00x1.svg", "notes.svg"};
  for (const std::string& name : others) put("part/" + name, "mine");
  for (const char* name : {"layer_0000.svg", "layer_0001.svg", "layer_123456.svg"})
    put(std::string("part/") + name, "old");
  { const auto stopped = begun(path("part"), 2, 2); }
  EXPECT_EQ(names("part").size(), 7U);
  EXPECT_EQ(read_file(path("part/layer_0001.svg")), "old");
  begun(path("part"), 1, 1)->commit();
  Names left = others;
  left.emplace_back("layer_0000.svg");
  std::ranges::sort(left);
  EXPECT_EQ(names("part"), left);
  EXPECT_NE(read_file(path("part/layer_0000.svg")), "old");
  for (const std::string& name : others) EXPECT_EQ(read_file(path("part/" + name)), "mine");
}

TEST_F(OutlineLayers, OfARunThatStopsLeaveNoFolder) {
  { const auto stopped = begun(path("part"), 2, 1); }
  { const auto stopped = begun(path("part.cli"), 2, 1); }
  { const auto stopped = begun(path("part.svg"), 1, 1); }
  EXPECT_EQ(names(), Names{});
}

TEST_F(OutlineLayers, AreAllInOneFileForMachines) {
  const auto files = begun(path("part.cli"), 2, 2);
  EXPECT_EQ(names(), Names{"part.cli.part"});
  files->commit();
  const std::string text = read_file(path("part.cli"));
  // The specification (CLI 2.0) begins with $$HEADERSTART and ends with $$GEOMETRYEND. One more layer says where the
  // first one begins.
  EXPECT_TRUE(text.starts_with("$$HEADERSTART\n"));
  EXPECT_TRUE(text.ends_with("$$GEOMETRYEND\n"));
  EXPECT_EQ(count_in(text, "$$LAYER/"), 3U);
  EXPECT_EQ(count_in(text, "$$POLYLINE/"), 2U);
  EXPECT_LT(text.find("$$LAYER/0.5\n"), text.find("$$LAYER/1\n"));
}

TEST_F(OutlineLayers, ThatCannotBeWrittenAreErrors) {
  put("file", "");
  EXPECT_NE(failure_of([&] { begun(path("file/part"), 1, 0); }).find("part of the path is a file"), std::string::npos);
  EXPECT_NE(failure_of([&] { begun(path("file"), 1, 0); }).find("cannot write " + path("file") + ": "),
            std::string::npos);
  EXPECT_NE(failure_of([&] { begun(path("none/part.svg"), 1, 0); }).find("the folder is missing"), std::string::npos);
  fill_disk_of("part.cli");
  EXPECT_NE(failure_of([&] { begun(path("part.cli"), 1, 0); }).find("No space left on device"), std::string::npos);
  std::filesystem::create_directory(path("part"));
  fill_disk_of("part/layer_0001.svg");
  EXPECT_NE(failure_of([&] { begun(path("part"), 2, 2); }).find("No space left on device"), std::string::npos);
  EXPECT_EQ(names("part"), Names{});
}

// A folder may have the name of a layer.
TEST_F(OutlineLayers, DoNotReplaceFolders) {
  std::filesystem::create_directories(path("part/layer_0001.svg/inside"));
  put("part/layer_0000.svg", "old");
  const auto files = begun(path("part"), 2, 2);
  EXPECT_NE(failure_of([&] {
              files->commit();
            }).find("cannot write " + path("part/layer_0001.svg") + ": Directory not empty; a folder has this name"),
            std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(path("part/layer_0001.svg/inside")));
}

}  // namespace ombre::exporting
