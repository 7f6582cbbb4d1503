#include "formats/mesh/mesh.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/system/test_source_files.h"
#include "base/text/error.h"
#include "base/text/test_errors.h"
#include "formats/containers/file.h"
#include "formats/packages/read_mesh.h"

namespace ombre::formats {
namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}, {0, 0, -2.25}};
const Triangles faces{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};

void put(std::string& bytes, const void* value, size_t size) { bytes.append(static_cast<const char*>(value), size); }
void put_float(std::string& bytes, double value) {
  const auto single = static_cast<float>(value);
  put(bytes, &single, 4);
}

std::string binary_stl(const std::string& header = "made by hand", uint32_t count = 4) {
  std::string bytes = header;
  bytes.resize(80, '\0');
  put(bytes, &count, 4);
  for (const auto& face : faces) {
    bytes.append(12, '\0');
    for (const uint32_t i : face)
      for (int axis = 0; axis < 3; ++axis) put_float(bytes, corners[i][axis]);
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string number(double value) { return std::to_string(value); }
std::string point(const Vec3& p) { return number(p.x) + ' ' + number(p.y) + ' ' + number(p.z); }

std::string text_solid(const std::string& name, size_t begin, size_t end) {
  std::string text = "solid " + name + "\n";
  for (size_t i = begin; i < end; ++i) {
    text += "  facet normal nan nan nan\n    outer loop\n";
    for (const uint32_t corner : faces[i]) text += "      vertex " + point(corners[corner]) + "\n";
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

std::string obj() {
  std::string text = "# by hand\n";
  for (const Vec3& p : corners) text += "v " + point(p) + "\n";
  for (const auto& f : faces)
    text += "f " + std::to_string(f[0] + 1) + ' ' + std::to_string(f[1] + 1) + ' ' + std::to_string(f[2] + 1) + "\n";
  return text;
}

std::string rows_of_numbers() {
  std::string text;
  for (const Vec3& p : corners) text += point(p) + "\n";
  for (const auto& f : faces)
    text += "3 " + std::to_string(f[0]) + ' ' + std::to_string(f[1]) + ' ' + std::to_string(f[2]) + "\n";
  return text;
}

std::string off(const std::string& header = "OFF\n") { return header + "4 4 6\n" + rows_of_numbers(); }

std::string ply_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment by hand\nobj_info nothing\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string binary_ply(bool big) {
  std::string bytes = ply_header(big ? "binary_big_endian" : "binary_little_endian");
  const auto put_ordered = [&](const void* value, size_t size) {
    std::string part(static_cast<const char*>(value), size);
    if (big) std::reverse(part.begin(), part.end());
    bytes += part;
  };
  for (const Vec3& p : corners)
    for (int axis = 0; axis < 3; ++axis) {
      const auto single = static_cast<float>(p[axis]);
      put_ordered(&single, 4);
    }
  for (const auto& f : faces) {
    bytes += '\3';
    for (const uint32_t i : f) put_ordered(&i, 4);
  }
  return bytes;
}

Mesh read_named(const std::string& name, const std::string& bytes) {
  Diagnostics diagnostics;
  const auto mesh = read_mesh(name, bytes, diagnostics);
  EXPECT_TRUE(mesh) << name << ": " << to_text(diagnostics);
  EXPECT_TRUE(diagnostics.list().empty()) << to_text(diagnostics);
  return mesh ? *mesh : Mesh{};
}

// Returns the messages about bytes that hold no mesh.
std::string message_of(const std::string& name, const std::string& bytes) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_mesh(name, bytes, diagnostics)) << name;
  EXPECT_EQ(diagnostics.error_count(), 1u);
  return to_text(diagnostics);
}

void expect_message_of(const std::string& name, const std::string& bytes, const std::string& part) {
  const std::string text = message_of(name, bytes);
  EXPECT_NE(text.find(part), std::string::npos) << "expected: " << part << "\nfound: " << text;
}

// Returns the corners of each triangle, so that the numbering of vertices does not matter.
std::vector<std::array<Vec3, 3>> shape(const Mesh& mesh) {
  std::vector<std::array<Vec3, 3>> triangles;
  for (const auto& t : mesh.triangles)
    triangles.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  return triangles;
}

TEST(Mesh, EveryFormatGivesTheSameTriangles) {
  Mesh expected;
  expected.vertices = corners;
  expected.triangles = faces;
  const std::vector<std::pair<std::string, std::string>> files{{"a.stl", binary_stl()},
                                                               {"b.stl", binary_stl("solid but binary")},
                                                               {"c.stl", text_solid("t", 0, 4)},
                                                               {"d.obj", obj()},
                                                               {"e.ply", ply_header("ascii") + rows_of_numbers()},
                                                               {"f.ply", binary_ply(false)},
                                                               {"g.ply", binary_ply(true)},
                                                               {"h.off", off()},
                                                               {"i.STL", binary_stl()},
                                                               {"ply called.stl", binary_ply(true)},
                                                               {"off without extension", off()}};
  for (const auto& [name, bytes] : files) {
    SCOPED_TRACE(name);
    const Mesh mesh = read_named(name, bytes);
    EXPECT_EQ(shape(mesh), shape(expected));
    EXPECT_EQ(mesh.vertices.size(), 4u);
    ASSERT_EQ(mesh.groups.size(), 1u);
    EXPECT_EQ(mesh.groups[0].triangle_count, 4u);
  }
}

TEST(Mesh, UnknownFormatsAreNamed) {
  expect_message_of("a.xyz", "1 2 3\n", "neither the name nor the content tells which mesh format this is");
  expect_message_of("a.dae", "<x/>", "name the file .3mf, .amf, .glb, .gltf, .obj, .off, .ply or .stl");
  expect_message_of("a.glb", "glTF", "this binary glTF file ends in its header");
}

TEST(Mesh, EmptyFilesAreNamed) {
  for (const std::string ending : {"stl", "obj", "ply", "off"})
    expect_message_of("a." + ending, "", "a." + ending + ": error: the file is empty");
}

TEST(Mesh, GarbageIsAMessage) {
  std::string garbage;
  for (uint32_t i = 0; i < 3000; ++i) garbage += static_cast<char>(i * i * 7919 >> 5);
  for (const std::string ending : {"stl", "obj", "ply", "off"})
    EXPECT_FALSE(message_of("a." + ending, garbage).empty());
}

TEST(Mesh, EveryTruncationIsAMeshOrAMessage) {
  const std::vector<std::pair<std::string, std::string>> files{{"a.stl", binary_stl()},
                                                               {"c.stl", text_solid("t", 0, 4)},
                                                               {"d.obj", obj()},
                                                               {"e.ply", ply_header("ascii") + rows_of_numbers()},
                                                               {"f.ply", binary_ply(false)},
                                                               {"h.off", off()}};
  for (const auto& [name, bytes] : files)
    for (size_t size = 0; size < bytes.size(); ++size) {
      Diagnostics diagnostics;
      const auto mesh = read_mesh(name, bytes.substr(0, size), diagnostics);
      ASSERT_NE(mesh.has_value(), diagnostics.has_errors()) << name << " cut to " << size;
    }
}

TEST(File, SaysWhichFoldersWereSearched) {
  Diagnostics diagnostics;
  expect_error([&] { read_mesh("no/such.stl", diagnostics); },
               "cannot read no/such.stl: No such file or directory (looked for /");
  EXPECT_THROW(read_file(source_file()), Error);
  const std::string pipe = testing::TempDir() + "/ombre_pipe_" + std::to_string(::getpid());
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(read_file(pipe), Error);  // which nobody writes to
  ::unlink(pipe.c_str());
  EXPECT_NE(read_file(source_file("CMakeLists.txt")).find("project(ombre"), std::string::npos);
}

TEST(Stl, CutShortSaysWhatIsMissing) {
  std::string bytes = binary_stl("header", 1200);
  bytes.resize(59000, '\0');
  EXPECT_EQ(
      message_of("wing.stl", bytes),
      "wing.stl: error: this binary STL is cut short: its header promises 1,200 triangles (60,084 bytes), the file "
      "has 59,000 bytes\n");
  expect_message_of("a.stl", binary_stl("solid x").substr(0, 200),
                    "promises 4 triangles (284 bytes), the file has 200 bytes");
  expect_message_of("a.stl", std::string(20, 'x'), "this is not an STL file");
  expect_message_of("a.stl", binary_stl("none", 0).substr(0, 84), "has no triangles");
}

TEST(Stl, BytesAfterTheLastTriangleAreAWarning) {
  Diagnostics diagnostics;
  EXPECT_TRUE(read_stl("a.stl", binary_stl() + "more", diagnostics));
  EXPECT_NE(to_text(diagnostics).find("warning: a.stl: 4 bytes after the last of 4 triangles"), std::string::npos);
  // Trailing bytes with the length of a triangle are ignored if they cannot be one.
  for (const char fill : {'\0', '\xFF'}) {
    Diagnostics others;
    const auto mesh = read_stl("a.stl", binary_stl() + std::string(50, fill), others);
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->triangles.size(), 4u);
    EXPECT_NE(to_text(others).find("50 bytes after the last of 4 triangles are not read"), std::string::npos);
  }
}

TEST(Stl, CoordinatesMustBeNumbers) {
  std::string bytes = binary_stl();
  const float bad = std::nanf("");
  std::memcpy(bytes.data() + 84 + 50 + 12 + 12, &bad, 4);
  expect_message_of("a.stl", bytes, "corner 2 of triangle 2 (at byte 158) is not a usable point: (nan, ");
  expect_message_of("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\n",
                    "a.stl:4:10: error: expected a coordinate of a corner, found \"nan\", which is not a number");
  expect_message_of("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 1e400 0\n", "is too large");
}

TEST(Stl, ZeroHasOneSign) {
  std::string text = text_solid("t", 0, 4);
  for (size_t at = text.find("vertex 0.000000"); at != std::string::npos; at = text.find("vertex 0.000000", at + 20))
    if (at % 2 == 0) text.replace(at, 15, "vertex -0.00000");
  EXPECT_EQ(read_named("a.stl", text).vertices.size(), 4u);
}

TEST(Stl, SolidsAreGroups) {
  const Mesh mesh =
      read_named("a.stl", text_solid("left wing", 0, 1) + text_solid("empty", 0, 0) + text_solid("right", 1, 4));
  ASSERT_EQ(mesh.groups.size(), 2u);
  EXPECT_EQ(mesh.groups[0].name, "left wing");
  EXPECT_EQ(mesh.groups[1].name, "right");
  EXPECT_EQ(mesh.groups[1].first_triangle, 1u);
  EXPECT_EQ(mesh.groups[1].triangle_count, 3u);
}

TEST(Stl, TextMistakesPointAtTheWord) {
  EXPECT_EQ(message_of("a.stl", "solid a\n  facet normal 0 0 1\n  outer lop\n"),
            "a.stl:3:9: error: expected \"loop\" where a facet's corners begin, found \"lop\"\n"
            "  3 |   outer lop\n"
            "    |         ^~~\n");
  expect_message_of("a.stl", "solid a\nfacet normal 0 0 1\n", "this STL is cut short: expected \"outer\"");
  expect_message_of("a.stl", "solid a\nendsolid a\n", "this STL has no facets");
  expect_message_of("a.stl", "solid a\nsolid b\n", "expected \"facet\" or \"endsolid\", found \"solid\"");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::vector<std::array<Vec3, 3>> expected_shape() {
  Mesh expected;
  expected.vertices = corners;
  expected.triangles = faces;
  return shape(expected);
}

// Checks that the bytes are read with a warning.
void expect_warning(const std::string& name, const std::string& bytes, const std::string& warning) {
  Diagnostics diagnostics;
  const auto mesh = read_mesh(name, bytes, diagnostics);
  ASSERT_TRUE(mesh) << to_text(diagnostics);
  EXPECT_EQ(shape(*mesh), expected_shape());
  EXPECT_EQ(to_text(diagnostics), "warning: " + name + ": " + warning + "\n");
}

TEST(Stl, TextsOfManyProgramsAreRead) {
  const std::string text = text_solid("t", 0, 4);
  const std::vector<std::string> texts{"\xEF\xBB\xBF" + text,
                                       replaced(text, "endloop", "end loop"),
                                       replaced(text, "endfacet", "END FACET"),
                                       replaced(text, "endsolid", "end solid"),
                                       replaced(text, "endsolid t", "endsolidt"),
                                       replaced(text, "solid t\n", std::string("solid t\0\0\n", 10)),
                                       replaced(text, "outer loop", "outerloop"),
                                       replaced(text, "facet normal nan nan nan", "facet"),
                                       replaced(text, "nan nan nan", ""),
                                       replaced(text, "\n", " "),
                                       replaced(text, "\n", "\r"),
                                       replaced(text, "0.000000", ".0D+00"),
                                       replaced(text, "1.500000", "0.15+001"),
                                       text + "\x1A",
                                       text + std::string(100, '\0'),
                                       text.substr(text.find("facet"))};
  for (const std::string& file : texts) {
    SCOPED_TRACE(file);
    EXPECT_EQ(shape(read_named("a.stl", file)), expected_shape());
  }
  expect_warning("a.stl", replaced(text, "1.500000", "1,500000"),
                 "\"1,500000\" is taken for a number with a decimal comma, as are others");
}

TEST(Stl, SolidsWithoutAnEndAreWarnedOf) {
  const std::string text = text_solid("t", 0, 4);
  expect_warning("a.stl", text.substr(0, text.find("endsolid")),
                 "a solid ends without \"endsolid\"; its facets are read");
  const std::string first = text_solid("s", 0, 2), second = text_solid("t", 2, 4);
  expect_warning("a.stl", first.substr(0, first.find("endsolid")) + second.substr(0, second.find("endsolid")),
                 "2 solids end without \"endsolid\"; their facets are read");
  expect_message_of("a.stl", text.substr(0, text.rfind("endfacet")), "this STL is cut short");
}

TEST(Stl, FacetsWithMoreCornersAreCut) {
  const Mesh mesh = read_named("a.stl",
                               "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n"
                               "vertex 0 1 0\nendloop\nendfacet\nendsolid\n");
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Stl, WrongCountsGiveWayToTheSize) {
  for (const auto& [count, text] :
       {std::pair<uint32_t, std::string>{0, "0"}, {3, "3"}, {1000, "1,000"}, {UINT32_MAX, "4,294,967,295"}})
    expect_warning("a.stl", binary_stl("made by hand", count),
                   "the header promises " + text + " triangles, but the file has 4, which are read");
}

TEST(Mesh, FilesThatAreNoMeshAreNamed) {
  for (const auto& [bytes, message] : std::vector<std::pair<std::string, std::string>>{
           {"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12\n",
            "this is no mesh file but a pointer of Git LFS, not the file itself; fetch the file: git lfs pull"},
           {"<!DOCTYPE html>\n<html><body>404</body></html>\n", "an HTML page"},
           {"\r\n  <HTML>", "an HTML page"},
           {"\x1F\x8B\x08 packed", "packed by gzip; unpack it"},
           {"\x89PNG\r\n\x1A\n", "a PNG picture"},
           {"ISO-10303-21;\nHEADER;\n", "a STEP file; write cad in place of mesh"},
           {std::string("\xFF\xFEs\0o\0l\0i\0d\0", 12), "text in UTF-16; save it as UTF-8"},
           {"# vtk DataFile Version 3.0\n", "a legacy file of VTK; save it as .vtu, .vti or .stl"},
           {"{\"a\": 1}", "this is no mesh file but JSON"}})
    for (const std::string ending : {"stl", "obj", "ply", "off", "3mf", "amf"})
      expect_message_of("a." + ending, bytes, message);
  expect_message_of(
      "a.stl", "Dear all,\nhere is the part.\n" + std::string(100, '.'),
      "a.stl: error: this is not an STL file: it is text that begins with \"Dear\" in place of \"solid\"");
  expect_message_of("a.stl", " \n\n", "it holds nothing but blanks");
  expect_message_of("a.stl", "3", "it is text that begins with \"3\"");
}

TEST(Obj, AllFormsOfCornersAndStatements) {
  const Mesh mesh =
      read_named("a.obj",
                 "mtllib a.mtl\no part\nv 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv +1 1e0 0\nv 0 1 -0\nvt 0 0\nvt 1 0 0\n"
                 "vt 1\nvn 0 0 1\ns off\nusemtl red\nf 1/1/1 2/2/1 3/3/1\nusemtl blue\nf -4/1 -2/3 \\\n  -1/-1 # done\n"
                 "g second\r\nf 1/1/ 2/2/ 3/3/\nl 1 2\n");
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
  EXPECT_EQ(mesh.texture_triangles, (Triangles{{0, 1, 2}, {0, 2, 2}, {0, 1, 2}}));
  EXPECT_EQ(mesh.texture_coordinates, (std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {1, 0}}));
  ASSERT_EQ(mesh.groups.size(), 3u);
  EXPECT_EQ(mesh.groups[0].name, "part");
  EXPECT_EQ(mesh.groups[0].material, "red");
  EXPECT_EQ(mesh.groups[1].name, "part");
  EXPECT_EQ(mesh.groups[1].material, "blue");
  EXPECT_EQ(mesh.groups[2].name, "second");
  EXPECT_EQ(mesh.groups[2].first_triangle, 2u);

  const Mesh bare = read_named("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl m\nvt 0 0\nf 1//1 2//2 3//3\n");
  EXPECT_TRUE(bare.texture_coordinates.empty());
  EXPECT_EQ(bare.groups[0].name, "m");
}

TEST(Obj, FacesWithoutTextureCoordinatesGetOne) {
  Diagnostics diagnostics;
  const auto mesh =
      read_obj("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 1 1\nf 1 2 3\nf 1/1 2/1 3/1\nf 1 2/1 3\n", diagnostics);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->texture_triangles, (Triangles{{1, 1, 1}, {0, 0, 0}, {1, 1, 1}}));
  EXPECT_EQ(mesh->texture_coordinates.back(), (std::array<double, 2>{0, 0}));
  EXPECT_NE(to_text(diagnostics).find("warning: a.obj: 2 triangles have no texture coordinates"), std::string::npos);
}

TEST(Obj, TextureCoordinatesThatAreNoNumbersBecomeZero) {
  Diagnostics diagnostics;
  const auto mesh =
      read_obj("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt nan nan\nvt a b\nvt 0.5D0 1,5\nf 1/1 2/2 3/3\n", diagnostics);
  ASSERT_TRUE(mesh) << to_text(diagnostics);
  EXPECT_EQ(mesh->texture_coordinates, (std::vector<std::array<double, 2>>{{0, 0}, {0, 0}, {0.5, 1.5}}));
  EXPECT_EQ(to_text(diagnostics), "warning: a.obj: 2 texture coordinates are no numbers and become (0, 0)\n");
}

TEST(Obj, MistakesPointAtTheWord) {
  EXPECT_EQ(message_of("a.obj", "v 0 0 0\nf 1 2 9\n"),
            "a.obj:2:5: error: the corner \"2\" uses vertex 2, but 1 vertices come before it\n"
            "  2 | f 1 2 9\n"
            "    |     ^\n");
  expect_message_of("a.obj", "v 1 2\n", "a.obj:1:6: error: expected a coordinate of a vertex, but the line ends here");
  expect_message_of("a.obj", "v 1 2 x\n", "expected a coordinate of a vertex, found \"x\"");
  expect_message_of("a.obj", "v 0 0 0\nf 1 1\n", "this OBJ file has no faces");
  expect_message_of("a.obj", "v 0 0 0\nf 1 0 1\n", "expected a corner of a face, found \"0\"");
  expect_message_of("a.obj", "v 0 0 0\nf 1 1/ 1/x\n", "expected a corner of a face, found \"1/x\"");
  expect_message_of("a.obj", "v 0 0 0\nf 99999999999999999999 1 1\n", "expected a corner of a face");
  expect_message_of("a.obj", "w 0 0 0\n", "an OBJ file has no statement \"w\"");
  expect_message_of("a.obj", "v 0 0 0\n", "this OBJ file has no faces");
}

const std::string no_part = "no part of the surface";

TEST(Obj, FacesOfTwoCornersAreNoPart) {
  expect_warning("a.obj", obj() + "f 1 2\n", "a face of fewer than three corners is " + no_part);
  expect_warning("a.obj", replaced(obj(), "f 1 2 3", "f -4 -3 -2\nf 1\nf 1 2"),
                 "2 faces of fewer than three corners are " + no_part);
}

// Corners are given as V/VN, or with texture coordinates that do not exist.
TEST(Obj, TextureCoordinatesNeedNotBeThere) {
  const std::string normals = "vn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\n";
  for (const std::string form : {"/1", "/1/1", "/-9/1", "/4"}) {
    std::string text = obj() + "# end\n";
    for (const char* face : {"f 1 2 3", "f 1 4 2", "f 2 4 3", "f 1 3 4"}) {
      const std::string was(face);
      text = replaced(text, was,
                      "f " + was.substr(2, 1) + form + ' ' + was.substr(4, 1) + form + ' ' + was.substr(6, 1) + form);
    }
    EXPECT_EQ(shape(read_named("a.obj", normals + text)), expected_shape()) << form;
  }
  Diagnostics diagnostics;
  ASSERT_TRUE(read_obj("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 1 1\nf 1/1 2/2 3/3\n", diagnostics));
  EXPECT_EQ(to_text(diagnostics), "warning: a.obj: 2 corners use texture coordinates that the file does not have\n");
}

TEST(Obj, WhatIsNotReadIsCounted) {
  expect_warning("a.obj", obj() + "surf 0 1 0 1 1 2\nsurf 0 1 0 1 1 2\n", "2 statements \"surf\" are not read");
  expect_warning("a.obj", obj() + "vc 1 1 1\n", "a statement \"vc\" is not read");
}

TEST(Ply, LinesMayHoldMoreThanTheHeaderSays) {
  const std::string text = ply_header("ascii") + rows_of_numbers();
  EXPECT_EQ(shape(read_named("a.ply", replaced(text, "\n3 ", " 7 7\n3 "))), expected_shape());
  // With fewer or more lines than elements, line ends have no meaning.
  const size_t body = text.find("end_header\n") + 11;
  EXPECT_EQ(shape(read_named("a.ply", text.substr(0, body) + replaced(text.substr(body), "\n", " "))),
            expected_shape());
  EXPECT_EQ(shape(read_named("a.ply", text.substr(0, body) + replaced(text.substr(body), " ", "\n"))),
            expected_shape());
}

// One list contains two strips: the tetrahedron's first three faces, and its last.
TEST(Ply, StripsOfTrianglesAreRead) {
  const std::string header = replaced(replaced(ply_header("ascii"), "face 4", "tristrips 1"), "list uchar", "list int");
  std::string text = rows_of_numbers();
  text = header + text.substr(0, text.find("3 0 1 2")) + "10 2 0 1 3 2 -1 0 2 3 -1\n";
  const Mesh mesh = read_named("a.ply", text);
  EXPECT_EQ(mesh.triangles, (Triangles{{2, 0, 1}, {1, 0, 3}, {1, 3, 2}, {0, 2, 3}}));
  expect_message_of("a.ply", replaced(text, "-1 0", "-2 0"), "uses vertex -2");
}

TEST(Ply, WhatIsNoSurfaceIsCounted) {
  std::string text = replaced(ply_header("ascii"), "face 4", "face 6") + rows_of_numbers() + "2 0 1\n0\n";
  expect_warning("a.ply", text, "2 faces of fewer than three corners are " + no_part);
  text = replaced(ply_header("ascii"), "end_header", "element patch 1\nproperty int n\nend_header");
  expect_warning("a.ply", text + rows_of_numbers() + "5\n", "an element \"patch\" is not read");
}

TEST(Off, LinesMeanNothingBeforeColours) {
  const std::vector<std::string> files{
      replaced(off(), "\n", " "),          replaced(off(), "\n", "\n\n"),
      replaced(off(), " ", "\n"),          replaced(off(), "\n3 ", " 0.5 0.5 0.5\n3 "),
      replaced(off(), "\n3 ", "\n  3\n "), replaced(replaced(off(), "00\n", "00 "), "\n3 ", "\n\n3 ")};
  for (const std::string& file : files) EXPECT_EQ(shape(read_named("a.off", file)), expected_shape()) << file;
  const Mesh mesh = read_named("a.off",
                               "STCNOFF 3 1 0 0 0 0 0 0 1 1 0 0 1 0.25 0.5 1 0 0 0 0 1 1 0 0 1 0.75 1 0 1 0 0 0 1 1 0 "
                               "0 1 0 0 3 0 1 2");
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(mesh.texture_coordinates[1], (std::array<double, 2>{0.75, 1}));
}

TEST(Off, TheHeaderMayTouchTheCountOrBeLeftOut) {
  const std::string with_nul("OFF\0\0", 5);
  for (const std::string& header : std::vector<std::string>{"OFF", "COFF", "NOFF", "\xEF\xBB\xBFOFF", "", with_nul})
    EXPECT_EQ(shape(read_named("a.off", off(header))), expected_shape()) << header;
  EXPECT_EQ(shape(read_named("called otherwise", off("OFF"))), expected_shape());
  expect_message_of("a.off", "OFFx 1 1\n", "found \"OFFx\"");
}

TEST(Off, FacesOfTwoCornersAreNoPart) {
  expect_warning("a.off", replaced(off(), "4 4 6", "4 6 6") + "2 0 1\n1 3\n",
                 "2 faces of fewer than three corners are " + no_part);
}

TEST(Ply, ExtraElementsAndPropertiesArePassedOver) {
  const Mesh mesh = read_named(
      "a.ply",
      "ply\r\nformat ascii 1.0\r\nelement camera 2\r\nproperty list uint double matrix\r\nproperty short id\r\n"
      "element empty 99999999999\r\nelement vertex 4\r\nproperty uchar red\r\nproperty float64 x\r\n"
      "property float y\r\nproperty int16 z\r\nproperty float u\r\nproperty float v\r\nelement face 1\r\n"
      "property uint8 quality\r\nproperty list uint8 uint32 vertex_index\r\nend_header\r\n"
      "3 nan inf 0.5 1\r\n0 2\r\n255 0 0 0 0 0\r\n255 1 0 0 1 0\r\n255 1 1 0 1 1\r\n255 0 1 0 0 1\r\n7 4 0 1 2 3\r\n");
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.texture_triangles, mesh.triangles);
  EXPECT_EQ(mesh.texture_coordinates[2], (std::array<double, 2>{1, 1}));
}

TEST(Ply, MistakesSayWhere) {
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string text = ply_header("ascii") + rows_of_numbers();
  const std::string binary = binary_ply(false);
  expect_message_of("a.ply", changed(text, "ascii", "binary"),
                    "a.ply:2:8: error: expected ascii, binary_little_endian or");
  expect_message_of("a.ply", changed(text, "float x", "real x"), "expected the type of a property, found \"real\"");
  expect_message_of("a.ply", changed(text, "float x", "float w"), "lack one of the properties x, y, z");
  expect_message_of("a.ply", changed(text, "vertex_indices", "corners"), "lack the list vertex_indices");
  expect_message_of("a.ply", changed(text, "vertex 4", "vertex 40000000000"), "promises 40,000,000,000 of \"vertex\"");
  expect_message_of("a.ply", changed(text, "3 0 1 2", "3 0 1 4"),
                    "a.ply:16:7: error: face 0 uses vertex 4, but the 4 vertices");
  expect_message_of("a.ply", changed(text, "3 0 1 2", "3 0 1 1.5"), "face 0 uses vertex 1.5");
  expect_message_of("a.ply", changed(text, "3 0 1 2", "3000 0 1 1"),
                    "a list of 3000 values is more than the file has room for");
  expect_message_of("a.ply", changed(text, "list uchar", "list float"), "the length of a list must be a whole number");
  expect_message_of("a.ply", "ply\nformat ascii 1.0\n", "its header has no end_header");
  expect_message_of("a.ply", "ply\nend_header\n", "without a format line");
  expect_message_of("a.ply", "play\n", "a PLY file begins with the word ply");
  expect_message_of(
      "a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty int x\nproperty int y\nproperty int z\nend_header\n",
      "this PLY file has no faces");
  expect_message_of("a.ply", binary.substr(0, binary.size() - 1),
                    "this PLY is cut short: expected the number of a vertex at byte 298, the file has 301 bytes");
  std::string bad = binary;
  bad[bad.size() - 1] = '\x7f';
  expect_message_of("a.ply", bad,
                    "face 3 uses vertex 2130706435, but the 4 vertices before it are numbered from 0 (at byte ");
}

TEST(Off, HeaderVariants) {
  for (const std::string header : {"OFF\n", "# comment\nOFF # more\n# again\n", "OFF "}) {
    EXPECT_EQ(read_named("a.off", off(header)).triangles, faces) << header;
  }
  const Mesh mesh =
      read_named("a.off",
                 "STCNOFF\n3 1 0\n\n0 0 0  0 0 1  1 0 0 1  0.25 0.5\n# between\n1 0 0  0 0 1  1 0 0 1  0.75 1\n"
                 "0 1 0  0 0 1  1 0 0 1  0 0\n3 0 1 2  255 0 0\n");
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(mesh.texture_coordinates[1], (std::array<double, 2>{0.75, 1}));
  EXPECT_EQ(read_named("a.off", "COFF 3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2").triangles.size(),
            1u);
  EXPECT_EQ(read_named("a.off", "NOFF 3 1\n0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n3 0 1 2 0.5").triangles.size(), 1u);
}

TEST(Off, MistakesPointAtTheWord) {
  expect_message_of("a.off", "OF\n",
                    "a.off:1:1: error: expected OFF, COFF, NOFF or STOFF at the beginning, found \"OF\"");
  expect_message_of("a.off", "4OFF\n", "only OFF files in three dimensions");
  expect_message_of("a.off", "OFF BINARY\n", "binary OFF files cannot be read");
  expect_message_of("a.off", "OFF 9999999 1 0\n0 0 0\n",
                    "promises 9,999,999 vertices, more than the file has room for");
  expect_message_of("a.off", "OFF 3 0 0\n0 0 0\n0 0 0\n0 0 0\n", "this OFF file has no faces");
  expect_message_of("a.off", "OFF 3 1 0\n0 0 0\n0 0 0\n0 0 0\n3 0 1 3\n", "a.off:5:7: error: the face uses vertex 3");
  expect_message_of("a.off", "OFF 3 1 0\n0 0 0\n0 0 0\n0 0 0\n2 0 1\n", "this OFF file has no faces");
  expect_message_of("a.off", "OFF 3 1 0\n0 0 0\n0 0 0\n0 0 0\n99 0 1 3\n", "more than the file has room for");
  expect_message_of("a.off", "OFF 3 2 0\n0 0 0\n0 0 0\n0 0 0\n3 0 1 2      \n",
                    "2 faces are promised, the file ends after 1");
}

}  // namespace
}  // namespace ombre::formats
