#include <gtest/gtest.h>

#include "formats/mesh/mesh_objects.h"
#include "formats/packages/package_readers.h"
#include "formats/packages/test_packages.h"

#ifdef OMBRE_3MF

namespace ombre::formats {
namespace {

using namespace test;

const std::string spaces =
    "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" "
    "xmlns:n=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/balls/2020/07\" requiredextensions=\"b n\"";

std::string lattice_object(int id, const std::string& attributes, const std::string& content,
                           const std::string& of_object = "") {
  return "<object id=\"" + std::to_string(id) + "\" name=\"grid\" " + of_object +
         "><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"10\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"20\" "
         "z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"30\"/></vertices><b:beamlattice " +
         attributes + ">" + content + "</b:beamlattice></mesh></object>\n";
}

std::string beams(const std::string& content) { return "<b:beams>" + content + "</b:beams>"; }

std::string beam_file(const std::string& attributes, const std::string& content, const std::string& before = "",
                      const std::string& of_object = "") {
  return archive(model(before + lattice_object(9, attributes, content, of_object), "<item objectid=\"9\"/>", spaces));
}

const std::string two_beams = "<b:beam v1=\"0\" v2=\"1\"/><b:beam v1=\"0\" v2=\"3\" r1=\"2\" r2=\"3\"/>";

Mesh read_quietly(const std::string& bytes) {
  Diagnostics diagnostics;
  const auto mesh = read_3mf("a.3mf", bytes, diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  return mesh.value_or(Mesh{});
}

TEST(ThreeMfBeams, RadiiAndCapsHaveDefaults) {
  const Mesh mesh =
      read_quietly(beam_file("minlength=\"0.01\" radius=\"1.5\" cap=\"butt\"",
                             beams("<b:beam v1=\"0\" v2=\"1\"/><b:beam v1=\"0\" v2=\"2\" r1=\"2\" cap2=\"hemisphere\"/>"
                                   "<b:beam v1=\"3\" v2=\"2\" r1=\"2\" r2=\"0.5\" cap1=\"sphere\"/>")));
  EXPECT_TRUE(mesh.triangles.empty());
  ASSERT_EQ(mesh.lattices.size(), 1u);
  EXPECT_EQ(mesh.lattices[0].group.name, "grid");
  const BeamLattice& lattice = *mesh.lattices[0].lattice;
  ASSERT_EQ(lattice.beams.size(), 3u);
  using Radii = std::array<double, 2>;
  using Caps = std::array<BeamCap, 2>;
  EXPECT_EQ(lattice.beams[0].radii, (Radii{1.5, 1.5}));
  EXPECT_EQ(lattice.beams[1].radii, (Radii{2, 2}));
  EXPECT_EQ(lattice.beams[2].radii, (Radii{2, 0.5}));
  EXPECT_EQ(lattice.beams[0].caps, (Caps{BeamCap::butt, BeamCap::butt}));
  EXPECT_EQ(lattice.beams[1].caps, (Caps{BeamCap::butt, BeamCap::hemisphere}));
  EXPECT_EQ(lattice.beams[2].caps, (Caps{BeamCap::sphere, BeamCap::butt}));
  EXPECT_EQ(lattice.vertices[lattice.beams[2].ends[0]], (Vec3{0, 0, 30}));
  EXPECT_EQ(lattice.vertices[lattice.beams[2].ends[1]], (Vec3{0, 20, 0}));
}

TEST(ThreeMfBeams, CapsAreSpheresWhereNothingIsSaid) {
  const Mesh mesh = read_quietly(beam_file("radius=\"1\"", beams(two_beams)));
  EXPECT_EQ(mesh.lattices[0].lattice->beams[0].caps[0], BeamCap::sphere);
}

TEST(ThreeMfBeams, BallsByMode) {
  const std::string content = beams(two_beams) + "<n:balls><n:ball vindex=\"3\" r=\"4\"/></n:balls>";
  const auto balls = [&](const std::string& attributes) {
    return read_quietly(beam_file("radius=\"1\" " + attributes, content)).lattices[0].lattice->balls;
  };
  EXPECT_TRUE(balls("").empty());
  EXPECT_TRUE(balls("n:ballmode=\"none\" n:ballradius=\"2\"").empty());
  const auto mixed = balls("n:ballmode=\"mixed\" n:ballradius=\"2\"");
  ASSERT_EQ(mixed.size(), 1u);
  EXPECT_EQ(mixed[0].radius, 4);
  // Vertex 2 belongs to no beam.
  const auto all = balls("n:ballmode=\"all\" n:ballradius=\"2\"");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].radius, 4);
  EXPECT_EQ(all[1].radius, 2);
}

TEST(ThreeMfBeams, ShortBeamsAreLeftOutAndCounted) {
  Diagnostics diagnostics;
  const auto mesh =
      read_3mf("a.3mf",
               beam_file("radius=\"1\" minlength=\"15\"", beams("<b:beam v1=\"0\" v2=\"1\"/><b:beam v1=\"0\" v2=\"2\"/>"
                                                                "<b:beam v1=\"2\" v2=\"2\"/>")),
               diagnostics);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->lattices[0].lattice->beams.size(), 1u);
  EXPECT_EQ(to_text(diagnostics),
            "warning: a.3mf: 2 beams that are shorter than their lattice's minlength are left out\n");
}

TEST(ThreeMfBeams, UniteWithTrianglesAndPlaces) {
  std::string both = object(1);
  both.insert(both.find("</mesh>"),
              "<b:beamlattice radius=\"1\">" + beams("<b:beam v1=\"0\" v2=\"3\"/>") +
                  "<b:beamsets><b:beamset name=\"a\"><b:ref index=\"0\"/></b:beamset></b:beamsets>"
                  "</b:beamlattice>");
  const Mesh mesh = read_quietly(
      archive(model(both, "<item objectid=\"1\" transform=\"2 0 0 0 2 0 0 0 2 5 6 7\"/><item objectid=\"1\"/>",
                    spaces + " unit=\"inch\"")));
  EXPECT_EQ(mesh.triangles.size(), 8u);
  ASSERT_EQ(mesh.lattices.size(), 2u);
  EXPECT_EQ(mesh.lattices[0].lattice, mesh.lattices[1].lattice);
  const Vec3 end = mesh.lattices[0].mm_from_lattice(mesh.lattices[0].lattice->vertices[1]);
  EXPECT_EQ(end, (Vec3{25.4 * 5, 25.4 * 6, 25.4 * 15}));
}

// The file's last beam has precedence where beams overlap, so its material comes first.
TEST(ThreeMfBeams, MaterialsComeLastFirst) {
  const std::string materials =
      "<basematerials id=\"5\"><base name=\"PLA\" displaycolor=\"#FF0000\"/><base name=\"TPU\" "
      "displaycolor=\"#00FF00\"/><base name=\"PA\" displaycolor=\"#0000FF\"/></basematerials>";
  const Mesh mesh = read_quietly(
      beam_file("radius=\"1\" pid=\"5\" pindex=\"0\" n:ballmode=\"mixed\" n:ballradius=\"2\"",
                beams("<b:beam v1=\"0\" v2=\"1\"/><b:beam v1=\"0\" v2=\"2\" p1=\"1\"/>"
                      "<b:beam v1=\"0\" v2=\"3\" p1=\"1\" p2=\"1\"/><b:beam v1=\"1\" v2=\"3\" p1=\"0\" p2=\"1\"/>") +
                    "<n:balls><n:ball vindex=\"3\" p=\"2\"/></n:balls>",
                materials));
  ASSERT_EQ(mesh.lattices.size(), 4u);
  EXPECT_EQ(mesh.lattices[0].group.material, "");  // a beam whose ends have different materials
  EXPECT_EQ(mesh.lattices[1].group.material, "TPU");
  EXPECT_EQ(mesh.lattices[1].lattice->beams.size(), 2u);
  EXPECT_EQ(mesh.lattices[2].group.material, "PLA");
  EXPECT_EQ(mesh.lattices[2].group.colour, (Rgba{255, 0, 0, 255}));
  EXPECT_EQ(mesh.lattices[3].group.material, "PA");
  EXPECT_EQ(mesh.lattices[3].lattice->balls.size(), 1u);
}

TEST(ThreeMfBeams, ClippingTakesAnObjectBefore) {
  const Mesh mesh =
      read_quietly(beam_file("radius=\"1\" clippingmode=\"outside\" clippingmesh=\"1\" representationmesh=\"1\"",
                             beams(two_beams), object(1)));
  const BeamLattice& lattice = *mesh.lattices[0].lattice;
  EXPECT_EQ(lattice.clipping, LatticeClipping::outside);
  ASSERT_TRUE(lattice.clip);
  EXPECT_EQ(lattice.clip->triangles.size(), 4u);
}

TEST(ThreeMfBeams, ObjectsAreFoundByName) {
  const std::string bytes =
      archive(model(object(1, "name=\"box\"") + lattice_object(2, "radius=\"1\"", beams(two_beams)),
                    "<item objectid=\"1\"/><item objectid=\"2\"/>", spaces));
  Mesh mesh = read_quietly(bytes);
  EXPECT_EQ(object_names(mesh), (std::vector<std::string>{"box", "grid"}));
  ASSERT_TRUE(keep_object(mesh, "grid"));
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_EQ(mesh.lattices.size(), 1u);
  mesh = read_quietly(bytes);
  ASSERT_TRUE(keep_object(mesh, "box"));
  EXPECT_TRUE(mesh.lattices.empty());
}

TEST(ThreeMfBeams, WrongLatticesAreExplained) {
  const auto expect = [](const std::string& attributes, const std::string& content, const std::string& message) {
    expect_message(beam_file(attributes, content, object(1)), message);
  };
  const std::string beam = beams("<b:beam v1=\"0\" v2=\"1\"/>");
  expect("", beam, "the beam has no radius, and its lattice has none either");
  expect("radius=\"0\"", beam, "the radius of beams is \"0\"; it must be greater than 0");
  expect("radius=\"1\"", beams("<b:beam v1=\"0\" v2=\"4\"/>"),
         "the beam uses vertex 4, but the 4 vertices of its object are numbered from 0");
  expect("radius=\"1\"", beams("<b:beam v1=\"0\" v2=\"1\" r1=\"thick\"/>"), "the radius of a beam");
  expect("radius=\"1\" cap=\"round\"", beam, "cap is \"round\"; it can be sphere, hemisphere, butt");
  expect("radius=\"1\" clippingmode=\"around\"", beam, "clippingmode is \"around\"; it can be none, inside, outside");
  expect("radius=\"1\" clippingmode=\"inside\"", beam, "the lattice is clipped, but has no clippingmesh");
  expect("radius=\"1\" clippingmode=\"inside\" clippingmesh=\"7\"", beam,
         "the clippingmesh 7 is no object with triangles before this one");
  expect("radius=\"1\" n:ballmode=\"all\"", beam, "the lattice has balls at all vertices but no ballradius");
  expect("radius=\"1\" n:ballmode=\"mixed\"", beam + "<n:balls><n:ball vindex=\"0\"/></n:balls>",
         "the ball has no radius, and its lattice has no ballradius");
}

TEST(ThreeMfBeams, UnknownElementsAreReported) {
  Diagnostics diagnostics;
  EXPECT_TRUE(read_3mf("a.3mf", beam_file("radius=\"1\"", beams(two_beams) + "<b:plates/>"), diagnostics));
  EXPECT_NE(to_text(diagnostics).find("(1 <plates>)"), std::string::npos) << to_text(diagnostics);
}

}  // namespace
}  // namespace ombre::formats

#endif
