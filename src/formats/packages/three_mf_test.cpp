#include <gtest/gtest.h>

#include <algorithm>

#include "formats/mesh/test_documents.h"
#include "formats/packages/package_readers.h"
#include "formats/packages/package_writers.h"
#include "formats/packages/read_mesh.h"
#include "formats/packages/test_packages.h"

#ifdef OMBRE_3MF

namespace ombre::formats {
namespace {

using namespace test;

std::optional<Rgba> opaque(std::optional<Rgba> colour) {
  if (colour) colour->at(3) = 255;
  return colour;
}

TEST(ThreeMf, NamesMaterialsAndColoursComeBack) {
  for (const auto flavour : {SlicerFlavour::generic, SlicerFlavour::prusa, SlicerFlavour::bambu, SlicerFlavour::orca,
                             SlicerFlavour::snapmaker}) {
    const Mesh mesh = read(package(pair(), flavour));
    EXPECT_NEAR(volume(mesh), 2 * tetrahedron_mm3, 1e-12);
    ASSERT_EQ(mesh.groups.size(), 2u);
    EXPECT_EQ(mesh.groups[0].triangle_count, 4u);
    EXPECT_EQ(mesh.groups[0].colour, (Rgba{255, 0, 0, 255}));
    EXPECT_EQ(mesh.groups[1].colour, (Rgba{0, 0, 255, 51}));
    EXPECT_EQ(mesh.groups[1].name, "right");
    EXPECT_EQ(mesh.groups[1].object, "pair");
    // Bambu Studio and OrcaSlicer have colours of filaments alone.
    EXPECT_EQ(mesh.groups[1].material, is_of_bambu(flavour) ? "" : "clear blue");
  }
}

TEST(ThreeMf, EqualDocumentsGiveEqualBytes) {
  EXPECT_EQ(package(pair(), SlicerFlavour::generic), package(pair(), SlicerFlavour::generic));
}

// Versions of libzip differ in the flag for UTF-8 names, which the names of 3MF's entries do not need.
TEST(ThreeMf, HasTheSameBytesWithAnyLibzip) {
  const std::string bytes = zipped({{"a", "text"}});
  ASSERT_EQ(bytes.substr(0, 4), "PK\x03\x04");
  EXPECT_EQ(bytes.substr(6, 2), std::string(2, '\0'));  // the flags
}

TEST(ThreeMf, UnitsBecomeMillimetres) {
  for (const auto& [unit, mm] :
       {std::pair{"micron", 0.001}, {"centimeter", 10.0}, {"inch", 25.4}, {"foot", 304.8}, {"meter", 1000.0}}) {
    const Mesh mesh = read(archive(model(object(1), "<item objectid=\"1\"/>", "unit=\"" + std::string(unit) + '"')));
    EXPECT_EQ(mesh.vertices[3], (Vec3{0, 0, 4 * mm})) << unit;
  }
  EXPECT_EQ(read(archive(model(object(1), "<item objectid=\"1\"/>", ""))).vertices[1], (Vec3{1, 0, 0}));
  expect_message(archive(model(object(1), "", "unit=\"mile\"")),
                 "a.3mf/3D/a.model:2:1: error: there is no unit \"mile\"");
}

// The matrix maps x, y, z to y, z, x. Then the outer matrix scales by two, then the item translates.
TEST(ThreeMf, TransformsMultiplyFromTheInside) {
  const std::string resources = object(1, "name=\"inner\"") +
                                components(2, "<component objectid=\"1\" transform=\"0 1 0 0 0 1 1 0 0 10 0 0\"/>") +
                                components(3, "<component objectid=\"2\" transform=\"2 0 0 0 2 0 0 0 2 0 0 0\"/>");
  const Mesh mesh = read(archive(model(resources, "<item objectid=\"3\" transform=\"1 0 0 0 1 0 0 0 1 0 0 5\"/>")));
  EXPECT_EQ(mesh.vertices[0], (Vec3{20, 0, 5}));
  EXPECT_EQ(mesh.vertices[1], (Vec3{20, 2, 5}));  // x was mapped to y
  EXPECT_EQ(mesh.vertices[2], (Vec3{20, 0, 9}));  // y was mapped to z
  EXPECT_EQ(mesh.vertices[3], (Vec3{28, 0, 5}));  // z was mapped to x
  EXPECT_NEAR(volume(mesh), 8 * tetrahedron_mm3, 1e-12);
  EXPECT_EQ(mesh.groups[0].name, "inner");
  EXPECT_EQ(mesh.groups[0].object, "object 3");
}

TEST(ThreeMf, MirroredObjectsStillFaceOutward) {
  const Mesh mesh = read(archive(model(object(1), "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>")));
  EXPECT_NEAR(volume(mesh), tetrahedron_mm3, 1e-12);
}

TEST(ThreeMf, TrianglesHaveTheirOwnMaterials) {
  const std::string resources =
      "<basematerials id=\"5\"><base name=\"a\" displaycolor=\"#102030\"/><base name=\"b\"/></basematerials>"
      "<m:colorgroup id=\"6\"><m:color color=\"#01020304\"/></m:colorgroup>" +
      object(1, "name=\"t\" pid=\"5\" pindex=\"0\"", "pid=\"6\" p1=\"0\"");
  const Mesh mesh = read(archive(model(resources)));
  ASSERT_EQ(mesh.groups.size(), 2u);
  EXPECT_EQ(mesh.groups[0].colour, (Rgba{1, 2, 3, 4}));
  EXPECT_EQ(mesh.groups[0].material, "");
  EXPECT_EQ(mesh.groups[1].material, "a");
  EXPECT_EQ(mesh.groups[1].colour, (Rgba{16, 32, 48, 255}));
  EXPECT_EQ(mesh.groups[1].first_triangle, 1u);
  const std::string beyond =
      "<basematerials id=\"5\"><base name=\"a\"/></basematerials>" + object(1, "pid=\"5\" pindex=\"1\"");
  expect_message(archive(model(beyond)), "the triangle uses property 1 of resource 5, which has 1 numbered from 0");
}

TEST(ThreeMf, ObjectsMayLieInOtherParts) {
  const std::string root =
      model(components(4, "<component p:path=\"/3D/Objects/b.model\" objectid=\"1\"/>"), "<item objectid=\"4\"/>",
            "unit=\"inch\" requiredextensions=\"p\" "
            "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\"");
  const Mesh mesh = read(zipped({relationships(), {"3D/a.model", root}, {"3D/Objects/b.model", model(object(1), "")}}));
  EXPECT_EQ(mesh.vertices[1], (Vec3{25.4, 0, 0}));
  expect_message(zipped({relationships(), {"3D/a.model", root}}),
                 "the archive's file \"3D/Objects/b.model\" is missing");
}

std::string prusa_config(const std::string& volumes) {
  return "<config><object id=\"1\">" + volumes + "</object></config>";
}

// One volume has all triangles but the last, the other only the last.
TEST(ThreeMf, VolumesOfPrusaSlicerAreGroups) {
  const auto with = [](const std::string& volumes) {
    return zipped({relationships(),
                   {"3D/a.model", model(object(1, "name=\"whole\""))},
                   {"Metadata/Slic3r_PE_model.config", prusa_config(volumes)}});
  };
  const std::string first = "<volume firstid=\"0\" lastid=\"2\"><metadata key=\"name\" value=\"body\"/></volume>";
  const auto last = [](const std::string& type) {
    return "<volume firstid=\"3\" lastid=\"3\"><metadata key=\"name\" value=\"more\"/>"
           "<metadata key=\"volume_type\" value=\"" +
           type + "\"/></volume>";
  };
  const Mesh both = read(with(first + last("ModelPart")));
  ASSERT_EQ(both.groups.size(), 2u);
  EXPECT_EQ(both.groups[0].name, "body");
  EXPECT_EQ(both.groups[1].name, "more");
  EXPECT_EQ(both.groups[1].object, "whole");
  EXPECT_EQ(read(with(first + last("ParameterModifier"))).triangles.size(), 3u);
  expect_message(with(last("ModelPart") + first), "volumes follow each other");
  Diagnostics diagnostics;
  EXPECT_TRUE(read_3mf("a.3mf", with(first + last("NegativeVolume")), diagnostics));
  EXPECT_NE(to_text(diagnostics).find("the negative volume \"more\" is left out"), std::string::npos);
}

// Returns an archive of Bambu Studio with an object of two parts, and the settings of both.
std::string bambu(const std::string& settings, const std::string& project = "") {
  const std::string resources =
      object(1) + object(2) + components(3, "<component objectid=\"1\"/><component objectid=\"2\"/>");
  return zipped({relationships(),
                 {"3D/a.model", model(resources, "<item objectid=\"3\"/>")},
                 {"Metadata/model_settings.config", "<config><object id=\"3\">" + settings + "</object></config>"},
                 {"Metadata/project_settings.config", project}});
}

TEST(ThreeMf, PartsOfBambuStudioHaveNames) {
  const Mesh mesh =
      read(bambu("<metadata key=\"name\" value=\"all\"/>"
                 "<part id=\"1\" subtype=\"normal_part\"><metadata key=\"name\" value=\"lid\"/></part>"
                 "<part id=\"2\" subtype=\"modifier_part\"/>"));
  ASSERT_EQ(mesh.groups.size(), 1u);
  EXPECT_EQ(mesh.groups[0].name, "lid");
  EXPECT_EQ(mesh.groups[0].object, "all");
}

// Parts with their own colours keep them; extruder 0 means that of the object.
TEST(ThreeMf, PartsWithoutColoursGetThoseOfTheirExtruders) {
  const auto with = [](const std::string& project) {
    return bambu(
        "<metadata key=\"extruder\" value=\"2\"/>"
        "<part id=\"1\" subtype=\"normal_part\"><metadata key=\"extruder\" value=\"1\"/></part>"
        "<part id=\"2\" subtype=\"normal_part\"><metadata key=\"extruder\" value=\"0\"/></part>",
        project);
  };
  const Mesh mesh = read(with("{\"filament_colour\": [\"#FF0000\", \"#0000FF80\"]}"));
  ASSERT_EQ(mesh.groups.size(), 2u);
  EXPECT_EQ(mesh.groups[0].colour, (Rgba{255, 0, 0, 255}));
  EXPECT_EQ(mesh.groups[1].colour, (Rgba{0, 0, 255, 128}));
  for (const char* project : {"", "[", "{\"filament_colour\": 3}", "{\"filament_colour\": [null, \"red\"]}"})
    EXPECT_FALSE(read(with(project)).groups[0].colour) << project;
}

TEST(ThreeMf, VolumesOfPrusaSlicerHaveColoursOfExtruders) {
  const auto with = [](const std::string& project) {
    return read(zipped({relationships(),
                        {"3D/a.model", model(object(1))},
                        {"Metadata/Slic3r_PE.config", project},
                        {"Metadata/Slic3r_PE_model.config",
                         prusa_config("<metadata type=\"object\" key=\"extruder\" value=\"2\"/>"
                                      "<volume firstid=\"0\" lastid=\"1\"/><volume firstid=\"2\" lastid=\"3\">"
                                      "<metadata type=\"volume\" key=\"extruder\" value=\"1\"/></volume>")}}));
  };
  const Mesh mesh = with("; generated\n; extruder_colour = \"\";#00ff00\n; filament_colour = #FF0000;#0000FF\n");
  ASSERT_EQ(mesh.groups.size(), 2u);
  EXPECT_EQ(mesh.groups[0].colour, (Rgba{0, 255, 0, 255}));
  EXPECT_EQ(mesh.groups[1].colour, (Rgba{255, 0, 0, 255}));
  EXPECT_FALSE(with("; filament_colour = ;\n").groups[0].colour);
}

TEST(ThreeMf, SupportsAreNoPart) {
  const std::string resources = object(1) + object(2, "type=\"support\"");
  EXPECT_EQ(read(archive(model(resources, "<item objectid=\"1\"/><item objectid=\"2\"/>"))).triangles.size(), 4u);
}

std::string warnings(const std::string& bytes) {
  Diagnostics diagnostics;
  EXPECT_TRUE(read_3mf("a.3mf", bytes, diagnostics));
  return to_text(diagnostics);
}

const std::string two_items = "<item objectid=\"1\"/><item objectid=\"2\"/>";

TEST(ThreeMf, SolidSupportsAreNoPart) {
  EXPECT_EQ(read(archive(model(object(1) + object(2, "type=\"solidsupport\""), two_items))).triangles.size(), 4u);
  EXPECT_EQ(read(archive(model(object(1) + object(2, "type=\"model\""), two_items))).triangles.size(), 8u);
}

TEST(ThreeMf, ObjectsOfOtherTypesAreCounted) {
  const std::string resources = object(1) + object(2, "type=\"other\"") + object(3, "type=\"other\"") +
                                object(4, "type=\"surface\"") + object(5, "type=\"other\"");
  EXPECT_EQ(warnings(archive(model(resources, two_items + "<item objectid=\"3\"/><item objectid=\"4\"/>"))),
            "warning: a.3mf: 2 objects of type \"other\" are no part of the solid and are left out\n"
            "warning: a.3mf: an object of type \"surface\" is no part of the solid and is left out\n");
}

TEST(ThreeMf, ItemsThatAreNotPrintedAreLeftOut) {
  const std::string resources = object(1) + object(2);
  const std::string first = "<item objectid=\"1\" printable=\"1\"/>";
  EXPECT_EQ(warnings(archive(model(resources, first + "<item objectid=\"2\" printable=\"0\"/>"))),
            "warning: a.3mf: item 2 of the build is marked printable=\"0\" and is left out\n");
  Diagnostics diagnostics;
  const auto mesh =
      read_3mf("a.3mf", archive(model(resources, first + "<item objectid=\"2\" p:printable=\"false\"/>")), diagnostics);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->triangles.size(), 4u);
}

TEST(ThreeMf, MeshesOfCuraThatChangeSettingsAreNoPart) {
  const auto with = [](const std::string& entry) {
    std::string second = object(2);
    second.insert(second.find("<mesh>"), entry);
    return archive(model(object(1) + second, two_items));
  };
  for (const std::string key : {"support_mesh", "anti_overhang_mesh", "infill_mesh"}) {
    const std::string name = "<metadatagroup><metadata name=\"cura:" + key + "\" type=\"xs:boolean\">";
    EXPECT_EQ(read(with(name + "True</metadata></metadatagroup>")).triangles.size(), 4u) << key;
    EXPECT_EQ(read(with(name + "False</metadata></metadatagroup>")).triangles.size(), 8u) << key;
    EXPECT_EQ(read(with("<settings xmlns=\"http://software.ultimaker.com/xml/cura/3mf/2015/10\"><setting key=\"" + key +
                        "\">True</setting></settings>"))
                  .triangles.size(),
              4u)
        << key;
  }
  EXPECT_EQ(warnings(with("<metadatagroup><metadata name=\"cura:cutting_mesh\">1</metadata></metadatagroup>")),
            "warning: a.3mf: an object that Cura cuts others by is no part of the solid and is left out\n");
}

TEST(ThreeMf, ExtensionsThatAreUsedAreReported) {
  std::string slices = object(1);
  slices.insert(slices.find("</mesh>"), "<s:slicestack><s:slice/></s:slicestack>");
  const std::string space = "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07";
  const std::string message =
      "warning: a.3mf/3D/a.model: what the 3MF extension \"s\" adds is not read: \"" + space + "\" (1 <slicestack>)\n";
  const std::string declared = "xmlns:s=\"" + space + '"';
  EXPECT_EQ(warnings(archive(model(slices, "<item objectid=\"1\"/>", declared))), message);
  EXPECT_EQ(warnings(archive(model(slices, "<item objectid=\"1\"/>", declared + " requiredextensions=\"s\""))),
            message);
  std::string own = object(1);
  own.insert(own.find("</mesh>"), "<slicestack xmlns=\"" + space + "\"/>");
  EXPECT_NE(warnings(archive(model(own))).find("what a 3MF extension adds is not read: \"" + space), std::string::npos);
  EXPECT_EQ(warnings(archive(model("<stack/>" + object(1) + "<stack/>"))),
            "warning: a.3mf/3D/a.model: elements of unknown names are not read: 2 <stack>\n");
}

TEST(ThreeMf, MixturesAreCounted) {
  const std::string mixed = "<m:compositematerials id=\"7\"/>" + object(1, "pid=\"7\" pindex=\"0\"");
  EXPECT_EQ(warnings(archive(model(mixed))),
            "warning: a.3mf: 4 triangles have their materials by <compositematerials>, which is not read\n");
}

// The triangles that are painted have the colour of their extruder, the others that of the body's extruder.
TEST(ThreeMf, PaintedTrianglesComeBack) {
  MeshDocument document = pair();
  document.bodies[0].paint = {2, 2, 0, 1};
  for (const auto flavour :
       {SlicerFlavour::prusa, SlicerFlavour::bambu, SlicerFlavour::orca, SlicerFlavour::snapmaker}) {
    const Mesh mesh = read(package(document, flavour));
    ASSERT_EQ(mesh.groups.size(), 4u);
    EXPECT_EQ(mesh.groups[0].triangle_count, 2u);
    EXPECT_EQ(opaque(mesh.groups[0].colour), (Rgba{0, 0, 255, 255})) << flavour_word(flavour);
    EXPECT_EQ(opaque(mesh.groups[1].colour), (Rgba{255, 0, 0, 255}));
    EXPECT_EQ(opaque(mesh.groups[2].colour), (Rgba{255, 0, 0, 255}));
    EXPECT_EQ(mesh.groups[3].name, "right");
  }
}

TEST(ThreeMf, PaintThatIsNotReadIsReported) {
  const auto painted = [](const std::string& attribute) { return warnings(archive(model(object(1, "", attribute)))); };
  for (const char* paint : {"paint_color=\"4\"", "slic3rpe:mmu_segmentation=\"4\""})
    EXPECT_EQ(
        painted(paint),
        "warning: a.3mf: triangles are painted with extruder 1, whose colour the file does not say; they have none\n");
  EXPECT_NE(painted("paint_color=\"841\"").find("painted in parts; all of it has the extruder of its largest part"),
            std::string::npos);
  EXPECT_EQ(painted("paint_color=\"1\""),
            "warning: a.3mf: a triangle has a paint that is not understood, and counts as unpainted\n");
  EXPECT_EQ(painted("paint_color=\"\""), "");
}

TEST(ThreeMf, ColoursOfCornersAreRead) {
  const std::string colours =
      "<m:colorgroup id=\"7\"><m:color color=\"#FF0000\"/><m:color color=\"#0000FF\"/></m:colorgroup>";
  const std::string shaded = archive(model(colours + object(1, "", "pid=\"7\" p1=\"0\" p2=\"1\" p3=\"0\"")));
  EXPECT_EQ(warnings(shaded), "");
  const Mesh mesh = read(shaded);
  ASSERT_EQ(mesh.shadings.size(), mesh.triangles.size());
  EXPECT_EQ(std::ranges::count_if(mesh.shadings,
                                  [](const TriangleShading& shading) {
                                    return shading.colours[0] == std::array<float, 4>{1, 0, 0, 1} &&
                                           shading.colours[1] == std::array<float, 4>{0, 0, 1, 1} &&
                                           shading.colours[2] == shading.colours[0] && shading.image < 0;
                                  }),
            1);
  const std::string plain = archive(model(colours + object(1, "", "pid=\"7\" p1=\"1\" p2=\"1\" p3=\"1\"")));
  EXPECT_EQ(warnings(plain), "");
  EXPECT_TRUE(read(plain).shadings.empty());
}

TEST(ThreeMf, UnknownExtensionsAreReported) {
  Diagnostics diagnostics;
  EXPECT_TRUE(read_3mf(
      "a.3mf", archive(model(object(1), "<item objectid=\"1\"/>", "requiredextensions=\"b\" xmlns:b=\"x/beams\"")),
      diagnostics));
  EXPECT_NE(to_text(diagnostics).find("what the 3MF extension \"b\" adds is not read: \"x/beams\""), std::string::npos);
}

TEST(ThreeMf, WrongModelsAreExplained) {
  expect_message(archive(model(object(1), "")), "nothing that is built has triangles");
  expect_message(archive(model(object(1), "<item objectid=\"7\"/>")), "there is no object 7 of 3D/a.model");
  expect_message(archive(model(object(1) + object(1))), "there are two objects with the number 1");
  expect_message(archive(model(components(1, "<component objectid=\"1\"/>"))), "consists of itself");
  expect_message(archive(model(object(1, "", "v3=\"1\""), "<item objectid=\"1\" transform=\"1 2 3\"/>")),
                 "a transform has 12 numbers, this one has 3");
  expect_message(archive(model(object(1), "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 0 0 0 0\"/>")),
                 "squeezes its object flat");
  expect_message(archive(model(object(1), "<item objectid=\"1\" transform=\"1e9 0 0 0 1e9 0 0 0 1e9 1e15 0 1e16\"/>")),
                 "comes to lie too far away");
  std::string text = model(object(1));
  text.replace(text.find("v2=\"2\""), 6, "v2=\"4\"");
  expect_message(archive(text), "a.3mf/3D/a.model:5:12: error: the triangle uses vertex 4, but the 4 vertices");
  text = model(object(1));
  text.replace(text.find("x=\"1\""), 5, "x=\"nan\"");
  expect_message(archive(text), "expected a coordinate of a vertex, found \"nan\"");
  text = model(object(1));
  text.replace(text.find("x=\"1\""), 5, "");
  expect_message(archive(text), "<vertex> lacks the attribute x");
  expect_message(archive(text.substr(0, 200)), "this is not XML");
}

TEST(ThreeMf, ObjectsThatMultiplyAreStopped) {
  std::string resources = object(1);
  for (int id = 2; id <= 21; ++id) {
    std::string ten;
    for (int i = 0; i < 10; ++i) ten += "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
    resources += components(id, ten);
  }
  expect_message(archive(model(resources, "<item objectid=\"21\"/>")), "its objects are repeated too often");
  std::string deep = object(1);
  for (int id = 2; id <= 60; ++id) deep += components(id, "<component objectid=\"" + std::to_string(id - 1) + "\"/>");
  expect_message(archive(model(deep, "<item objectid=\"60\"/>")), "go deeper than 32 levels");
  // Objects that were measured before count with their depth.
  expect_message(archive(model(deep, "<item objectid=\"30\"/><item objectid=\"60\"/>")), "go deeper than 32 levels");
}

TEST(ThreeMf, WrongPackagesAreExplained) {
  expect_message("", "the file is empty");
  expect_message("text", "this is not a 3MF file: those are zip archives");
  expect_message("PK\x03\x04 rest", "this zip archive is damaged or cut short");
  expect_message(zipped({{"hello.txt", "hello"}}),
                 "this zip archive is not a 3MF file: it has no file \"_rels/.rels\"");
  expect_message(zipped({{"_rels/.rels", "<Relationships/>"}}), "_rels/.rels lacks a relationship of the type 3dmodel");
  expect_message(zipped({{"read me.txt", "hello"}, {"parts/lid.STL", "solid"}}),
                 "it holds \"parts/lid.STL\": unpack it");
  expect_message(zipped({relationships("/../../etc/passwd")}), "the archive's file \"../../etc/passwd\" is missing");
}

TEST(ThreeMf, NamesInPackagesAreComparedLoosely) {
  const std::string text = model(object(1));
  const auto rels = [](const std::string& name, const std::string& target) {
    return std::pair{name, relationships(target).second};
  };
  const std::vector<std::vector<std::pair<std::string, std::string>>> packages{
      {rels("_rels\\.rels", "/3D/a.model"), {"3D\\a.model", text}},
      {rels("_RELS/.Rels", "3d/A.Model"), {"3D/a.model", text}},
      {rels("/_rels/.rels", "./3D/a.model"), {"./3D/a.model", text}},
      {rels("_rels/.rels", "/3D/my%20part.model"), {"3D/my part.model", text}},
      {rels("_rels/.rels", "/3D/my part.model"), {"3D/my%20part.model", text}}};
  for (const auto& files : packages) EXPECT_EQ(read(zipped(files)).triangles.size(), 4u) << files[1].first;

  const std::string root =
      model(components(4, "<component p:path=\"/3d/objects/B%2Emodel\" objectid=\"1\"/>"), "<item objectid=\"4\"/>");
  EXPECT_EQ(read(zipped({relationships(), {"3D/a.model", root}, {"3D\\Objects\\b.model", model(object(1), "")}}))
                .triangles.size(),
            4u);
}

TEST(ThreeMf, ThePackageNeedNotPointToItsOnlyModel) {
  const std::string text = model(object(1));
  EXPECT_EQ(warnings(zipped({{"folder/3D/3dmodel.model", text}})),
            "warning: a.3mf: it has no file \"_rels/.rels\"; the model \"folder/3D/3dmodel.model\" is read\n");
  EXPECT_EQ(warnings(zipped({{"_rels/.rels", "<Relationships/>"}, {"a.model", text}})),
            "warning: a.3mf: _rels/.rels lacks a relationship of the type 3dmodel; the model \"a.model\" is read\n");
}

TEST(ThreeMf, BombsAreNotUnpacked) {
  const std::string text = model(object(1)) + std::string(size_t{40} << 20, ' ');
  expect_message(archive(text), "is packed more tightly than 200 to 1");
}

TEST(ThreeMf, EncryptedFilesAreExplained) {
  std::string bytes = package(pair(), SlicerFlavour::generic);
  // Bit 0 of the flags in the local headers and in the directory marks encryption.
  for (size_t at = bytes.find("PK\x03\x04"); at != std::string::npos; at = bytes.find("PK\x03\x04", at + 4))
    bytes[at + 6] |= 1;
  for (size_t at = bytes.find("PK\x01\x02"); at != std::string::npos; at = bytes.find("PK\x01\x02", at + 4))
    bytes[at + 8] |= 1;
  expect_message(bytes, "the archive's file \"_rels/.rels\" is encrypted; save it without a password");
}

TEST(ThreeMf, EveryTruncationIsAMessage) {
  const std::string bytes = package(pair(), SlicerFlavour::generic);
  for (size_t size = 0; size < bytes.size(); ++size) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_3mf("a.3mf", bytes.substr(0, size), diagnostics)) << "cut to " << size;
    EXPECT_TRUE(diagnostics.has_errors());
  }
}

TEST(ThreeMf, ZippedAmfIsRead) {
  const std::string bytes = zipped({{"part.amf", whole(amf_bytes(pair()))}});
  Diagnostics diagnostics;
  const auto mesh = read_mesh("a.amf", bytes, diagnostics);
  ASSERT_TRUE(mesh) << to_text(diagnostics);
  EXPECT_EQ(mesh->groups[1].name, "right");
}

}  // namespace
}  // namespace ombre::formats

#endif
