#include "formats/packages/mesh_formats.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ombre::formats {
namespace {

TEST(MeshFormats, AreFoundByTheirEndings) {
  EXPECT_EQ(find_mesh_format("a/b.STL")->name, "STL");
  EXPECT_EQ(find_mesh_format("b.3mf")->ending, ".3mf");
  EXPECT_EQ(find_mesh_format("b.png"), nullptr);
  EXPECT_EQ(find_mesh_format("3mf"), nullptr);
  EXPECT_TRUE(std::ranges::is_sorted(mesh_formats(), {}, &MeshFormat::ending));
}

TEST(MeshFormats, AreReadOrWrittenInOneWay) {
  for (const MeshFormat& format : mesh_formats()) {
    EXPECT_TRUE(format.read || format.is_written()) << format.name;
    EXPECT_FALSE(format.bytes && format.write_package) << format.name;
    EXPECT_EQ(format.companion_ending.empty(), format.companion_bytes == nullptr) << format.name;
    EXPECT_TRUE(!format.recognises || format.read) << format.name;
  }
}

// The expected lists follow the specifications of the formats.
TEST(MeshFormats, ListsEndingsByWhatTheyHold) {
  using Endings = std::vector<std::string>;
  EXPECT_EQ(read_mesh_endings(), (Endings{".3mf", ".amf", ".glb", ".gltf", ".obj", ".off", ".ply", ".stl"}));
  EXPECT_EQ(written_mesh_endings(), (Endings{".3mf", ".amf", ".glb", ".obj", ".off", ".ply", ".stl"}));
  EXPECT_EQ(mesh_endings_with(&MeshFormat::holds_bodies), (Endings{".3mf", ".amf", ".glb", ".obj"}));
  EXPECT_EQ(mesh_endings_with(&MeshFormat::holds_colours), (Endings{".3mf", ".amf", ".glb", ".obj", ".ply"}));
  EXPECT_EQ(mesh_endings_with(&MeshFormat::holds_beams), (Endings{".3mf"}));
}

}  // namespace
}  // namespace ombre::formats
