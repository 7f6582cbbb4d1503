#include "formats/mesh/mesh_writers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "base/text/json.h"
#include "formats/mesh/test_documents.h"
#include "formats/packages/read_mesh.h"

namespace ombre::formats {
namespace {

using namespace test;

MeshDocument one() { return {"one", {}, {tetrahedron("t")}}; }

float float_at(const std::string& bytes, size_t at) {
  float value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

uint32_t u32_at(const std::string& bytes, size_t at) {
  uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

Mesh read_back(const std::string& name, const std::string& bytes) {
  Diagnostics diagnostics;
  const auto mesh = read_mesh(name, bytes, diagnostics);
  EXPECT_TRUE(mesh && diagnostics.list().empty()) << to_text(diagnostics);
  return mesh.value_or(Mesh{});
}

TEST(MeshWriters, StlIsTrianglesWithNormals) {
  const std::string bytes = whole(stl_bytes(one()));
  ASSERT_EQ(bytes.size(), 84u + 4 * 50);
  EXPECT_NE(bytes.substr(0, 5), "solid");
  EXPECT_EQ(u32_at(bytes, 80), 4u);
  // The first triangle lies in z = 0 and faces down; its corners are (0,0,0), (0,2,0) and (1,0,0).
  const std::array<float, 12> first{0, 0, -1, 0, 0, 0, 0, 2, 0, 1, 0, 0};
  for (size_t i = 0; i < first.size(); ++i) EXPECT_EQ(float_at(bytes, 84 + 4 * i), first[i]) << i;
  // The third has the normal (1/1, 1/2, 1/4), normalized.
  const double size = std::sqrt(1 + 0.25 + 0.0625);
  EXPECT_FLOAT_EQ(float_at(bytes, 184), static_cast<float>(1 / size));
  EXPECT_FLOAT_EQ(float_at(bytes, 192), static_cast<float>(0.25 / size));
}

TEST(MeshWriters, FlatTrianglesHaveNoNormal) {
  const MeshDocument flat{"", {}, {{"flat", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}}};
  const std::string bytes = whole(stl_bytes(flat));
  for (const size_t at : {84u, 88u, 92u}) EXPECT_EQ(float_at(bytes, at), 0);
}

TEST(MeshWriters, ObjNamesObjectsAndMaterials) {
  MeshDocument document = pair();
  document.bodies[1].vertex_colours.assign(4, {255, 0, 51, 255});
  EXPECT_EQ(whole(obj_bytes(document, "pair.mtl")),
            "# mm, z is up\nmtllib pair.mtl\n"
            "o left\nv 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 4\nusemtl red\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
            "o right\nv 10 0 0 1 0 0.2\nv 11 0 0 1 0 0.2\nv 10 2 0 1 0 0.2\nv 10 0 4 1 0 0.2\nusemtl clear_blue\n"
            "f 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n");
  EXPECT_EQ(whole(mtl_bytes(document)), "newmtl red\nKd 1 0 0\nd 1\nnewmtl clear_blue\nKd 0 0 1\nd 0.2\n");
}

TEST(MeshWriters, OffColoursFaces) {
  EXPECT_EQ(whole(off_bytes(pair())),
            "OFF\n# mm, z is up\n8 8 0\n0 0 0\n1 0 0\n0 2 0\n0 0 4\n10 0 0\n11 0 0\n10 2 0\n10 0 4\n"
            "3 0 2 1 255 0 0 255\n3 0 1 3 255 0 0 255\n3 1 2 3 255 0 0 255\n3 0 3 2 255 0 0 255\n"
            "3 4 6 5 0 0 255 51\n3 4 5 7 0 0 255 51\n3 5 6 7 0 0 255 51\n3 4 7 6 0 0 255 51\n");
}

TEST(MeshWriters, PlyColoursVertices) {
  const std::string bytes = whole(ply_bytes(pair()));
  const size_t begin = bytes.find("end_header\n") + 11;
  ASSERT_EQ(bytes.size(), begin + 8 * 16 + 8 * 13);
  // The sixth vertex is (11, 0, 0) in clear blue; the fifth face is 4 6 5.
  EXPECT_EQ(float_at(bytes, begin + 5 * 16), 11);
  EXPECT_EQ(bytes.substr(begin + 5 * 16 + 12, 4), std::string("\x00\x00\xFF\x33", 4));
  EXPECT_EQ(bytes[begin + 8 * 16 + 4 * 13], 3);
  EXPECT_EQ(u32_at(bytes, begin + 8 * 16 + 4 * 13 + 5), 6u);
}

TEST(MeshWriters, NumbersAreTheShortestFloats) {
  const MeshDocument document{"", {}, {{"t", {{0.1, -0.0, 1.0 / 3}, {1e-7, 16777217, 1e20}, {0, 0, 0}}, {{0, 1, 2}}}}};
  const std::string text = whole(off_bytes(document));
  EXPECT_NE(text.find("\n0.1 0 0.33333334\n1e-07 16777216 1e+20\n"), std::string::npos) << text;
}

TEST(MeshWriters, OurReadersReadThem) {
  const MeshDocument document = pair();
  for (const auto& [name, bytes] : {std::pair{"a.stl", stl_bytes(document)},
                                    {"a.obj", obj_bytes(document, "a.mtl")},
                                    {"a.ply", ply_bytes(document)},
                                    {"a.off", off_bytes(document)}}) {
    SCOPED_TRACE(name);
    const Mesh mesh = read_back(name, whole(bytes));
    EXPECT_EQ(mesh.triangles.size(), 8u);
    EXPECT_NEAR(volume(mesh), 2 * tetrahedron_mm3, 1e-12);
  }
  const Mesh mesh = read_back("a.obj", whole(obj_bytes(document, "a.mtl")));
  ASSERT_EQ(mesh.groups.size(), 2u);
  EXPECT_EQ(mesh.groups[1].name, "right");
  EXPECT_EQ(mesh.groups[1].material, "clear_blue");
}

TEST(MeshWriters, BodiesWithoutTrianglesAreLeftOut) {
  MeshDocument document = one();
  document.bodies.insert(document.bodies.begin(), {"nothing", {}, {}});
  EXPECT_EQ(whole(obj_bytes(document, "")), whole(obj_bytes(one(), "")));
  EXPECT_EQ(whole(glb_bytes(document)), whole(glb_bytes(one())));
}

TEST(MeshWriters, LargeBodiesComeInPieces) {
  MeshDocument document = one();
  document.bodies[0].triangles.resize(5000, {0, 1, 2});
  size_t pieces = 0, bytes = 0, greatest = 0;
  stl_bytes(document).write([&](std::string_view piece) {
    ++pieces;
    bytes += piece.size();
    greatest = std::max(greatest, piece.size());
  });
  EXPECT_EQ(bytes, 84u + 5000 * 50);
  EXPECT_EQ(stl_bytes(document).size(), bytes);
  EXPECT_GE(pieces, 3u);
  EXPECT_LT(greatest, 66000u);
}

class Glb : public testing::Test {
 protected:
  void make(const MeshDocument& document) {
    bytes_ = whole(glb_bytes(document));
    const uint32_t json_size = u32_at(bytes_, 12);
    Diagnostics diagnostics;
    const auto json = parse_json(make_source("json", bytes_.substr(20, json_size)), diagnostics);
    ASSERT_TRUE(json) << to_text(diagnostics);
    scene_ = *json;
    numbers_ = 20 + json_size + 8;
  }
  const Data& at(std::string_view list, size_t index) const { return scene_.find(list)->list()->at(index); }
  double number(const Data& data, std::string_view member) const { return *data.find(member)->number(); }
  std::vector<double> list(const Data& data, std::string_view member) const {
    std::vector<double> values;
    for (const Data& value : *data.find(member)->list()) values.push_back(*value.number());
    return values;
  }

  std::string bytes_;
  Data scene_;
  size_t numbers_ = 0;  // beginning of the numbers
};

TEST_F(Glb, HeaderSaysTheSizes) {
  make(pair());
  EXPECT_EQ(bytes_.substr(0, 4), "glTF");
  EXPECT_EQ(u32_at(bytes_, 4), 2u);
  EXPECT_EQ(u32_at(bytes_, 8), bytes_.size());
  EXPECT_EQ(bytes_.substr(16, 4), "JSON");
  EXPECT_EQ(bytes_.substr(numbers_ - 4, 4), std::string("BIN\0", 4));
  EXPECT_EQ(u32_at(bytes_, numbers_ - 8), bytes_.size() - numbers_);
  EXPECT_EQ(numbers_ % 4, 0u);
  // There are twice 4 points and 4 triangles.
  EXPECT_EQ(number(at("buffers", 0), "byteLength"), 2 * (4 * 12 + 4 * 12));
}

TEST_F(Glb, BodiesAreNodesInMetres) {
  make(pair());
  EXPECT_EQ(*at("nodes", 1).find("name")->string(), "right");
  EXPECT_EQ(list(at("nodes", 2), "children"), (std::vector<double>{0, 1}));
  // The columns of the matrix: x stays, y goes back, z goes up.
  EXPECT_EQ(list(at("nodes", 2), "matrix"),
            (std::vector<double>{0.001, 0, 0, 0, 0, 0, -0.001, 0, 0, 0.001, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(list(at("accessors", 2), "min"), (std::vector<double>{10, 0, 0}));
  EXPECT_EQ(list(at("accessors", 2), "max"), (std::vector<double>{11, 2, 4}));
  const size_t indices = numbers_ + static_cast<size_t>(number(at("bufferViews", 3), "byteOffset"));
  EXPECT_EQ(u32_at(bytes_, indices + 4), 2u);  // the second corner of 0 2 1
}

TEST_F(Glb, ColoursAreLinear) {
  MeshDocument document = pair();
  document.materials[0].colour = {255, 128, 0, 51};
  document.bodies[0].vertex_colours.assign(4, {255, 128, 10, 255});
  make(document);
  const Data& material = *at("materials", 0).find("pbrMetallicRoughness");
  const auto factor = list(material, "baseColorFactor");
  // The expected value is ((128 / 255 + 0.055) / 1.055) ^ 2.4.
  EXPECT_NEAR(factor[1], 0.2158605, 1e-7);
  EXPECT_EQ(factor[0], 1);
  EXPECT_EQ(factor[3], 0.2);
  EXPECT_EQ(*at("materials", 0).find("alphaMode")->string(), "BLEND");
  // The material is white, because colours of vertices are multiplied by it.
  EXPECT_EQ(number(at("meshes", 0).find("primitives")->list()->at(0), "material"), 2);
  const Data& white = *at("materials", 2).find("pbrMetallicRoughness");
  EXPECT_EQ(list(white, "baseColorFactor"), (std::vector<double>{1, 1, 1, 1}));
  const auto offset = static_cast<size_t>(number(at("bufferViews", 1), "byteOffset"));
  EXPECT_EQ(u32_at(bytes_, numbers_ + offset), 0xFFFFu | 14146u << 16);  // 65535 * 0.2158605
  EXPECT_EQ(u32_at(bytes_, numbers_ + offset + 4), 199u | 0xFFFF0000u);  // 65535 * 10 / 255 / 12.92 = 198.9
}

TEST_F(Glb, LeastAndGreatestAreThoseOfTheFloats) {
  make({"", {}, {{"t", {{0.1, 0, 0}, {0.3, 1, 0}, {0, 0, 1}}, {{0, 1, 2}}}}});
  EXPECT_EQ(list(at("accessors", 0), "max")[0], static_cast<double>(0.3f));
}

}  // namespace
}  // namespace ombre::formats
