#include "formats/packages/three_mf_beams_text.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "formats/mesh/mesh_objects.h"
#include "formats/mesh/test_documents.h"
#include "formats/packages/package_writers.h"
#include "formats/packages/test_packages.h"
#include "formats/packages/three_mf_text.h"

#ifdef OMBRE_3MF

namespace ombre::formats {
namespace {

using namespace test;

constexpr BeamCap ball = BeamCap::sphere, half = BeamCap::hemisphere, flat = BeamCap::butt;

WrittenBeams three_beams() {
  WrittenBeams written;
  written.name = "grid";
  written.vertices = {{0, 0, 0}, {8, 0, 0}, {0, 2, 0}, {0, 0, 4}};
  written.beams = {
      {{0, 1}, {0.5, 0.5}, {ball, ball}}, {{0, 2}, {0.5, 1}, {half, half}}, {{3, 0}, {1.5, 1.5}, {ball, flat}}};
  return written;
}

TEST(ThreeMfBeamsText, SaysWhatDiffersFromTheUsual) {
  // The least length is 2, reduced by 1/10000 for rounding.
  EXPECT_EQ(whole(beam_lattice_text(three_beams(), std::nullopt, 7)),
            "<b:beamlattice minlength=\"1.9998\" radius=\"0.5\">\n<b:beams>\n"
            "<b:beam v1=\"0\" v2=\"1\"/>\n"
            "<b:beam v1=\"0\" v2=\"2\" r1=\"0.5\" r2=\"1\" cap1=\"hemisphere\" cap2=\"hemisphere\"/>\n"
            "<b:beam v1=\"3\" v2=\"0\" r1=\"1.5\" cap2=\"butt\"/>\n"
            "</b:beams>\n</b:beamlattice>\n");
}

TEST(ThreeMfBeamsText, NamesMaterialsAndClips) {
  WrittenBeams written = three_beams();
  written.clipping = LatticeClipping::outside;
  written.materials = {4, 1, 4};
  const std::string text = whole(beam_lattice_text(written, 9, 7));
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "<b:beamlattice minlength=\"1.9998\" radius=\"0.5\" clippingmode=\"outside\" clippingmesh=\"9\" pid=\"7\" "
            "pindex=\"4\">");
  EXPECT_NE(text.find("v2=\"1\"/>"), std::string::npos);
  EXPECT_NE(text.find("p1=\"1\" p2=\"1\"/>"), std::string::npos);
}

TEST(ThreeMfBeamsText, TheUsualCapIsThatOfMostEnds) {
  WrittenBeams written = three_beams();
  written.beams[0].caps = {half, half};
  const std::string text = whole(beam_lattice_text(written, std::nullopt, 7));
  EXPECT_NE(text.find("radius=\"0.5\" cap=\"hemisphere\">"), std::string::npos);
  EXPECT_NE(text.find("<b:beam v1=\"0\" v2=\"1\"/>"), std::string::npos);
  EXPECT_NE(text.find("cap1=\"sphere\" cap2=\"butt\""), std::string::npos);
}

TEST(ThreeMfBeamsText, ModelsRequireTheExtension) {
  MeshDocument document = pair();
  EXPECT_EQ(whole(three_mf_model(document, SlicerFlavour::generic)).find("requiredextensions"), std::string::npos);
  document.beams = {three_beams()};
  document.beams[0].clipping = LatticeClipping::inside;
  document.clips = {tetrahedron("clip")};
  const std::string text = whole(three_mf_model(document, SlicerFlavour::generic));
  EXPECT_NE(text.find("xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" "
                      "requiredextensions=\"b\">"),
            std::string::npos);
  // Bodies have the ids 1 and 2, the whole 3, materials 4; colours would have 5 and 6.
  const size_t clip = text.find("<object id=\"7\" type=\"model\" name=\"clip\">"),
               beams = text.find("<object id=\"8\" type=\"model\" name=\"grid\">"), all = text.find("<object id=\"3\"");
  EXPECT_LT(clip, beams);
  EXPECT_LT(beams, all);
  EXPECT_LT(all, text.size());
  EXPECT_NE(text.find("clippingmesh=\"7\""), std::string::npos);
  EXPECT_EQ(text.find("<component objectid=\"7\"/>"), std::string::npos);
  EXPECT_NE(text.find("<component objectid=\"8\"/>", all), std::string::npos);
}

TEST(ThreeMfBeamsText, IsReadAsItWas) {
  MeshDocument document{"part", {{"red", {255, 0, 0, 255}}, {"blue", {0, 0, 255, 255}}}, {}};
  document.beams = {three_beams()};
  document.beams[0].materials = {1, 0, 1};
  document.beams[0].clipping = LatticeClipping::outside;
  document.clips = {tetrahedron("clip")};
  const Mesh mesh = read(package(document, SlicerFlavour::generic));
  EXPECT_TRUE(mesh.triangles.empty());
  ASSERT_EQ(mesh.lattices.size(), 2u);
  size_t beams = 0;
  for (const PlacedLattice& placed : mesh.lattices) {
    const BeamLattice& lattice = *placed.lattice;
    EXPECT_EQ(placed.group.name, "grid");
    EXPECT_EQ(lattice.clipping, LatticeClipping::outside);
    ASSERT_TRUE(lattice.clip);
    EXPECT_DOUBLE_EQ(volume(*lattice.clip), tetrahedron_mm3);
    for (const Beam& beam : lattice.beams) {
      const auto is_it = [&](const Beam& written) {
        return written.radii == beam.radii && written.caps == beam.caps &&
               document.beams[0].vertices[written.ends[0]] == lattice.vertices[beam.ends[0]] &&
               document.beams[0].vertices[written.ends[1]] == lattice.vertices[beam.ends[1]];
      };
      EXPECT_EQ(std::ranges::count_if(document.beams[0].beams, is_it), 1);
    }
    beams += lattice.beams.size();
  }
  EXPECT_EQ(beams, 3u);
}

}  // namespace
}  // namespace ombre::formats

#endif
