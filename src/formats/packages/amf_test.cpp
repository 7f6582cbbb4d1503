#include <gtest/gtest.h>

#include "formats/mesh/mesh_writers.h"
#include "formats/mesh/test_documents.h"
#include "formats/packages/package_readers.h"
#include "formats/packages/package_writers.h"
#include "formats/packages/read_mesh.h"

#ifdef OMBRE_3MF

namespace ombre::formats {
namespace {

using namespace test;

Mesh read_quiet_amf(const std::string& bytes) {
  Diagnostics diagnostics;
  const auto mesh = read_mesh("a.amf", bytes, diagnostics);
  EXPECT_TRUE(mesh && diagnostics.list().empty()) << to_text(diagnostics);
  return mesh.value_or(Mesh{});
}

std::string amf_message(const std::string& bytes) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_amf("a.amf", bytes, diagnostics));
  EXPECT_EQ(diagnostics.error_count(), 1u);
  return to_text(diagnostics);
}

void expect_amf_message(const std::string& bytes, const std::string& part) {
  const std::string text = amf_message(bytes);
  EXPECT_NE(text.find(part), std::string::npos) << "expected: " << part << "\nfound: " << text;
}

// Returns an object written by hand.
std::string amf_object(const std::string& corner = "0") {
  std::string text = "<object id=\"1\"><metadata type=\"name\">t</metadata><mesh><vertices>";
  for (const std::string& point : {"<x>" + corner + "</x><y>0</y><z>0</z>", std::string("<x>1</x><y>0</y><z>0</z>"),
                                   std::string("<x>0</x><y>2</y><z>0</z>"), std::string("<x>0</x><y>0</y><z>4</z>")})
    text += "<vertex><coordinates>" + point + "</coordinates></vertex>\n";
  text += "</vertices><volume>";
  for (const char* triangle : {"<v1>0</v1><v2>2</v2><v3>1</v3>", "<v1>0</v1><v2>1</v2><v3>3</v3>",
                               "<v1>1</v1><v2>2</v2><v3>3</v3>", "<v1>0</v1><v2>3</v2><v3>2</v3>"})
    text += std::string("<triangle>") + triangle + "</triangle>\n";
  return text + "</volume></mesh></object>\n";
}

std::string amf(const std::string& inner, const std::string& unit = "millimeter") {
  return "<?xml version=\"1.0\"?>\n<amf unit=\"" + unit + "\">\n" + inner + "</amf>\n";
}

TEST(Amf, NamesMaterialsAndColoursComeBack) {
  const Mesh mesh = read_quiet_amf(whole(amf_bytes(pair())));
  EXPECT_NEAR(volume(mesh), 2 * tetrahedron_mm3, 1e-12);
  ASSERT_EQ(mesh.groups.size(), 2u);
  EXPECT_EQ(mesh.groups[0].name, "left");
  EXPECT_EQ(mesh.groups[1].material, "clear blue");
  EXPECT_EQ(mesh.groups[1].object, "pair");
  EXPECT_EQ(mesh.groups[1].colour, (Rgba{0, 0, 255, 51}));
}

TEST(Amf, VolumesTellSlicersTheirSettings) {
  MeshDocument document = pair();
  document.bodies[1].settings = {{"fill_density", "15%"}};
  const std::string text = whole(amf_bytes(document));
  EXPECT_NE(text.find("<volume materialid=\"2\">\n<metadata type=\"name\">right</metadata>\n"
                      "<metadata type=\"slic3r.extruder\">2</metadata>\n"
                      "<metadata type=\"slic3r.fill_density\">15%</metadata>\n<triangle><v1>4</v1>"),
            std::string::npos)
      << text;
}

TEST(Amf, WhatXmlCannotHoldIsReplaced) {
  MeshDocument document = pair();
  document.bodies[0].name = "a<b>&\"c\"\x01\xFF \xC3\xA4";
  EXPECT_EQ(read_quiet_amf(whole(amf_bytes(document))).groups[0].name, "a<b>&\"c\"?? \xC3\xA4");
}

TEST(Amf, UnitsBecomeMillimetres) {
  EXPECT_NEAR(volume(read_quiet_amf(amf(amf_object(), "inch"))), tetrahedron_mm3 * 25.4 * 25.4 * 25.4, 1e-6);
  EXPECT_NEAR(volume(read_quiet_amf(amf(amf_object(), "micron"))), tetrahedron_mm3 * 1e-9, 1e-18);
  expect_amf_message(amf(amf_object(), "parsec"), "there is no unit \"parsec\"; it can be millimeter");
}

TEST(Amf, ConstellationsPlaceObjects) {
  const Mesh mesh = read_quiet_amf(
      amf(amf_object() + "<constellation id=\"c\"><instance objectid=\"1\"><deltax>5</deltax><rz>90</rz></instance>"
                         "<instance objectid=\"1\"><rx>90</rx></instance></constellation>"));
  EXPECT_NEAR(volume(mesh), 2 * tetrahedron_mm3, 1e-12);
  EXPECT_EQ(mesh.vertices[1], (Vec3{5, 1, 0}));  // x was rotated to y and translated
  EXPECT_EQ(mesh.vertices[6], (Vec3{0, 0, 2}));  // y was rotated to z
  EXPECT_EQ(mesh.groups[0].object, "constellation c");
}

// Returns a file with one object in one place.
std::string placed(const std::string& inner, const std::string& beside = "") {
  return amf(beside + amf_object() + "<constellation id=\"c\"><instance objectid=\"1\">" + inner +
             "</instance></constellation>");
}

std::string amf_warnings(const std::string& bytes) {
  Diagnostics diagnostics;
  EXPECT_TRUE(read_amf("a.amf", bytes, diagnostics));
  return to_text(diagnostics);
}

// As in PrusaSlicer, mirroring and scaling come first: x goes to -2; 3 times y goes to x after the rotation.
TEST(Amf, InstancesAreScaledAndMirrored) {
  const Mesh mesh =
      read_quiet_amf(placed("<scalex>2</scalex><scaley>3</scaley><scalez>0.5</scalez><mirrorx>-1</mirrorx>"
                            "<mirrory>1</mirrory><deltax>1</deltax><rz>90</rz>"));
  EXPECT_EQ(mesh.vertices[1], (Vec3{1, -2, 0}));
  EXPECT_EQ(mesh.vertices[2], (Vec3{-5, 0, 0}));
  EXPECT_EQ(mesh.vertices[3], (Vec3{1, 0, 2}));
  EXPECT_NEAR(volume(mesh), 3 * tetrahedron_mm3, 1e-12);
  EXPECT_NEAR(volume(read_quiet_amf(placed("<scale>2</scale>"))), 8 * tetrahedron_mm3, 1e-12);
  expect_amf_message(placed("<scalez>0</scalez>"), "this squeezes its object flat: it is scaled by 0");
}

TEST(Amf, SlicersFromSlic3rTurnByRadians) {
  for (const char* program : {"Slic3r 1.2.9", "PrusaSlicer-2.7", "SuperSlicer 2.5"}) {
    const std::string by = std::string("<metadata type=\"cad\">") + program + "</metadata>";
    const Mesh mesh = read_quiet_amf(placed("<rz>1.570796</rz>", by));
    EXPECT_EQ(mesh.vertices[1], (Vec3{0, 1, 0})) << program;
    const Mesh sixth = read_quiet_amf(placed("<rz>0.523599</rz>", by));
    EXPECT_NEAR(sixth.vertices[1].y, 0.5, 1e-6) << program;
  }
  const Mesh degrees = read_quiet_amf(placed("<rz>90</rz>", "<metadata type=\"cad\">FreeCAD</metadata>"));
  EXPECT_EQ(degrees.vertices[1], (Vec3{0, 1, 0}));
}

TEST(Amf, VolumesThatAreNoSolidAreLeftOut) {
  const std::string whole_object = amf_object();
  const auto with_second = [&](const std::string& begin) {
    std::string text = whole_object;
    const size_t end = text.find("</volume>") + std::string("</volume>").size();
    const size_t triangle = text.find("<triangle>");
    text.insert(end, begin + text.substr(triangle, end - triangle));
    return amf(text);
  };
  for (const char* begin :
       {"<volume><metadata type=\"slic3r.modifier\">1</metadata>", "<volume type=\"support\">",
        "<volume><metadata type=\"slic3r.volume_type\">ParameterModifier</metadata>",
        "<volume><metadata type=\"slic3r.volume_type\">SupportBlocker</metadata>",
        "<volume><metadata type=\"slic3r.modifier\">0</metadata><metadata type=\"slic3r.volume_type\">"
        "SupportEnforcer</metadata>"})
    EXPECT_EQ(read_quiet_amf(with_second(begin)).triangles.size(), 4u) << begin;
  EXPECT_EQ(read_quiet_amf(with_second("<volume><metadata type=\"slic3r.volume_type\">ModelPart</metadata>"))
                .triangles.size(),
            8u);
  EXPECT_NE(amf_warnings(with_second("<volume><metadata type=\"slic3r.volume_type\">NegativeVolume</metadata>"))
                .find("a.amf: a negative volume is left out, not taken away from the others"),
            std::string::npos);
}

TEST(Amf, VolumesWithoutColoursGetThoseOfTheirExtruders) {
  std::string text = amf_object();
  text.insert(text.find("<triangle>"), "<metadata type=\"slic3r.extruder\">2</metadata>");
  const Mesh mesh = read_quiet_amf(
      amf("<metadata type=\"slic3rpe_config\">\n; filament_colour = #FF0000;#0000FF\n</metadata>" + text));
  EXPECT_EQ(mesh.groups[0].colour, (Rgba{0, 0, 255, 255}));
}

TEST(Amf, WhatIsNotUnderstoodIsCounted) {
  std::string curved = amf_object();
  for (size_t at = curved.find("</coordinates>"); at != std::string::npos; at = curved.find("</coordinates>", at + 20))
    curved.insert(at + 14, "<normal/>");
  EXPECT_EQ(amf_warnings(amf(curved)), "warning: a.amf: 4 elements <normal> of <vertex> are not read\n");
  EXPECT_EQ(amf_warnings(placed("<skew>1</skew>")), "warning: a.amf: an element <skew> of <instance> is not read\n");
  EXPECT_EQ(amf_warnings(amf("<material id=\"5\"><composite materialid=\"6\">x</composite></material>" + amf_object())),
            "warning: a.amf: an element <composite> of <material> is not read\n");
  std::string many;
  for (int i = 0; i < 30; ++i) many += "<new" + std::to_string(i) + "/>";
  EXPECT_NE(amf_warnings(amf(many + amf_object())).find("a.amf: 10 things of other kinds are not read"),
            std::string::npos);
}

TEST(Amf, InstancesThatAreNotPrintedAreLeftOut) {
  const std::string bytes = amf(amf_object() +
                                "<constellation id=\"c\"><instance objectid=\"1\"/>"
                                "<instance objectid=\"1\"><printable>0</printable></instance></constellation>");
  EXPECT_EQ(amf_warnings(bytes),
            "warning: a.amf: an instance of object 1 is marked as not printable and is left out\n");
}

TEST(Amf, WrongFilesAreExplained) {
  expect_amf_message("", "the file is empty");
  expect_amf_message("<amf><object", "a.amf:1:");
  expect_amf_message("<svg/>", "expected the element <amf>, found \"svg\"");
  expect_amf_message(amf(amf_object("nan")), "expected a coordinate of a vertex, found \"nan\"");
  expect_amf_message(amf(amf_object("1e16")), "is too large");
  expect_amf_message(amf(amf_object("")), "expected a coordinate of a vertex, found \"\"");
  expect_amf_message(amf(amf_object() + amf_object()), "there are two objects with the id \"1\"");
  expect_amf_message(amf(""), "nothing that is built has triangles");
  expect_amf_message(amf(amf_object() + "<constellation id=\"c\"><instance objectid=\"7\"/></constellation>"),
                     "there is no object 7");
  expect_amf_message(amf("<constellation id=\"c\"><instance objectid=\"c\"/></constellation>" + amf_object() +
                         "<constellation id=\"d\"><instance objectid=\"c\"/></constellation>"),
                     "the object c consists of itself");
  std::string wrong = amf(amf_object());
  wrong.replace(wrong.find("<v3>3"), 5, "<v3>9");
  expect_amf_message(wrong, "a.amf:8:1: error: the triangle uses vertex 9, but the 4 vertices of its object");
}

TEST(Amf, EntitiesDoNotGrow) {
  std::string laughs = "<?xml version=\"1.0\"?>\n<!DOCTYPE amf [<!ENTITY a \"0000000000\">";
  for (char c = 'b'; c <= 'j'; ++c) {
    laughs += "<!ENTITY " + std::string(1, c) + " \"";
    for (int i = 0; i < 10; ++i) laughs += "&" + std::string(1, static_cast<char>(c - 1)) + ";";
    laughs += "\">";
  }
  expect_amf_message(laughs + "]>\n<amf>" + amf_object("&j;") + "</amf>",
                     "expected a coordinate of a vertex, found \"&j;\"");
}

TEST(Amf, EveryTruncationIsAMeshOrAMessage) {
  const std::string bytes = whole(amf_bytes(pair()));
  for (size_t size = 0; size < bytes.size(); ++size) {
    Diagnostics diagnostics;
    const auto mesh = read_amf("a.amf", bytes.substr(0, size), diagnostics);
    ASSERT_NE(mesh.has_value(), diagnostics.has_errors()) << "cut to " << size;
  }
}

}  // namespace
}  // namespace ombre::formats

#endif
