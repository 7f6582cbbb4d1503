#include "formats/mesh/files_beside.h"

#include <gtest/gtest.h>

namespace ombre::formats {
namespace {

using Paths = std::vector<std::string>;

// References, as RFC 3986 writes them, become paths.
TEST(PathOfUri, IsDecoded) {
  EXPECT_EQ(path_of_uri("a.bin"), "a.bin");
  EXPECT_EQ(path_of_uri("maps/my%20scan%231.jpg"), "maps/my scan#1.jpg");
  EXPECT_EQ(path_of_uri("%C3%BC.bin"), "\xC3\xBC.bin");
  EXPECT_EQ(path_of_uri("\xC3\xBC.bin"), "\xC3\xBC.bin");
  EXPECT_EQ(path_of_uri("100%25.bin"), "100%.bin");
  EXPECT_EQ(path_of_uri("maps/a:b.bin"), "maps/a:b.bin");
  EXPECT_EQ(path_of_uri("../maps/a.png"), "../maps/a.png");
}

TEST(PathOfUri, LeadsToNoOtherPlace) {
  for (const std::string_view uri :
       {"", "/etc/passwd", "%2Fetc/passwd", "\\\\server\\a.bin", "%5Cserver", "http://a.org/a.bin", "HTTPS://a.org",
        "file:///a.bin", "C:\\a.bin", "C:/a.bin", "a%", "a%2", "a%zz.bin", "a%-1.bin", "a%00.bin", "a\nb", "a%7Fb"})
    EXPECT_EQ(path_of_uri(uri), std::nullopt) << uri;
}

TEST(GltfFiles, AreThoseOfBuffersAndBaseColours) {
  const std::string text = R"({"asset": {"version": "2.0"},
    "buffers": [{"uri": "a%20b.bin"}, {"uri": "data:;base64,AAAA"}, {"uri": "a b.bin"}, {"uri": "c.bin"}],
    "images": [{"uri": "normals.png"}, {"uri": "colours.jpg"}, {"bufferView": 0}],
    "textures": [{"source": 0}, {"source": 1}, {"source": 2}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}, "normalTexture": {"index": 0}}, {},
                  {"pbrMetallicRoughness": {"baseColorTexture": {"index": 2}}}]})";
  const GltfFiles files = gltf_files("a.gltf", text);
  EXPECT_EQ(files.buffers, (Paths{"a b.bin", "c.bin"}));
  EXPECT_EQ(files.images, (Paths{"colours.jpg"}));
  EXPECT_EQ(gltf_buffer_files("a.gltf", text), files.buffers);
}

TEST(GltfFiles, AreNoneOfWhatIsNotRead) {
  for (const std::string_view text :
       {"", "{", R"({"buffers": [{"uri": 5}]})", R"({"buffers": {"uri": "a"}})", R"({"buffers": [{"uri": "/a"}]})",
        R"({"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}}], "x": "uri"})"})
    EXPECT_TRUE(gltf_files("a.gltf", text).buffers.empty()) << text;
}

}  // namespace
}  // namespace ombre::formats
