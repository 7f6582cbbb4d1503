#include "jobs/scad/scad_job.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "formats/containers/file.h"
#include "formats/mesh/mesh.h"
#include "formats/packages/package_writers.h"
#include "solids/kernel.h"
#include "solids/test_trees.h"
#include "sources/solid_parts.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;
using namespace solids;

class ScadJob : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_kernel()) GTEST_SKIP();
    // Tests run at the same time, each in a folder of its own.
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("ombre_scad_job_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  ScadResult run(const TreePtr& tree, const std::string& name, bool no_overlap = false) {
    messages_ = {};
    ScadRequest request{tree, {{path(name)}}};
    request.no_overlap = no_overlap;
    return run_scad(request, messages_);
  }

  TreePtr imported(const std::string& name) const {
    Import import;
    import.path = path(name);
    return node(import);
  }

  std::string first_message() const { return messages_.list().empty() ? "" : messages_.list()[0].message; }

  fs::path folder_;
  Diagnostics messages_;
};

TreePtr two_parts() {
  return group({part("left", {material("PLA", {colour(red, {cube(1)})})}),
                part("right", {material("TPU", {moved(1, 0, 0, {cube(2)})})}), moved(9, 0, 0, {cube(3)})});
}

TEST_F(ScadJob, ThreeMfKeepsNamesMaterialsAndColours) {
  if (!formats::can_write_3mf()) GTEST_SKIP();
  EXPECT_EQ(run(two_parts(), "a.3mf").files.size(), 1U);
  EXPECT_TRUE(messages_.list().empty());
  EXPECT_EQ(described(imported("a.3mf")), "1 red part left of PLA; 8 part right of TPU; 27");
}

TEST_F(ScadJob, AmfKeepsNamesMaterialsAndColours) {
  if (!formats::can_write_3mf()) GTEST_SKIP();
  run(two_parts(), "a.amf");
  // The solid without a part has the name of the file's object, which AMF gives to all volumes without one.
  EXPECT_TRUE(described(imported("a.amf")).starts_with("1 red part left of PLA; 8 part right of TPU; 27"));
}

TEST_F(ScadJob, BodiesAreNamedByTheirPartOrMaterialOrColour) {
  const Pieces pieces = evaluated(
      group({part("left", {colour(red, {cube(1)})}), moved(9, 0, 0, {material("PLA", {colour(red, {cube(1)})})}),
             moved(19, 0, 0, {colour(red, {cube(1)})}), moved(29, 0, 0, {colour({0.2, 0.4, 0.6, 1}, {cube(1)})}),
             moved(39, 0, 0, {colour({1, 0, 0, 0.2}, {cube(1)})}), moved(49, 0, 0, {cube(1)})}));
  std::vector<std::string> names;
  for (const formats::MeshBody& body : document_of(pieces, "a").bodies) names.push_back(body.name);
  EXPECT_EQ(names, (std::vector<std::string>{"left", "PLA", "red", "#336699", "#ff000033", ""}));
}

TEST_F(ScadJob, EveryFormatHoldsTheVolume) {
  for (const std::string name : {"a.stl", "a.off", "a.obj", "a.ply"}) {
    run(two_parts(), name);
    double volume = 0;
    for (const Piece& piece : evaluated(imported(name))) volume += size_of(piece);
    EXPECT_NEAR(volume, 36, 1e-4) << name;
  }
  EXPECT_EQ(run(two_parts(), "a.glb").files.size(), 1U);
}

TEST_F(ScadJob, AFileForEachPart) {
  const ScadResult result = run(two_parts(), "out-{part}.stl");
  EXPECT_EQ(result.files,
            (std::vector<std::string>{path("out-left.stl"), path("out-right.stl"), path("out-rest.stl")}));
  EXPECT_EQ(described(imported("out-right.stl")), "8");
}

TEST_F(ScadJob, OverlapsAreReportedOrCut) {
  // Listing 4.1 of the thesis.
  const TreePtr tree = group({colour(red, {cube(10, 10, 20)}), colour(green, {cube(10, 20, 10)})});
  EXPECT_EQ(described(run(tree, "a.obj").pieces), "2000 red; 2000 green");
  EXPECT_EQ(first_message(), "a solid in red and a solid in green overlap");
  EXPECT_EQ(described(run(tree, "a.obj", true).pieces), "2000 red; 1000 green");
  EXPECT_TRUE(messages_.list().empty());
}

TEST_F(ScadJob, SolidsThatAFormatDoesNotTellApartAreUnited) {
  const TreePtr tree = group({colour(red, {cube(10, 10, 20)}), colour(green, {cube(10, 20, 10)})});
  for (const std::string name : {"a.stl", "a.off"}) {
    run(tree, name);
    EXPECT_TRUE(messages_.list().empty()) << name;
    EXPECT_EQ(described(imported(name)), "3000") << name;
  }
}

TEST_F(ScadJob, WrongFormats) {
  EXPECT_TRUE(run(cube(1), "a.xyz").files.empty());
  EXPECT_EQ(first_message(), path("a.xyz") + " has no ending of a format");
  EXPECT_TRUE(run(cube(1), "a.svg").files.empty());
  EXPECT_EQ(first_message(), path("a.svg") + " is not written: the design is solid");
  EXPECT_TRUE(run(square(1, 1), "a.stl").files.empty());
  EXPECT_EQ(first_message(), path("a.stl") + " is not written: the design is flat");
  EXPECT_TRUE(run(nothing(), "a.stl").files.empty());
  EXPECT_EQ(first_message(), path("a.stl") + " is not written: the design is empty");
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ScadJob, Drawings) {
  const TreePtr tree =
      group({part("frame", {colour(red, {difference({square(4, 4), moved(1, 1, 0, {square(1, 1)})})})}),
             moved(9, 0, 0, {square(1, 1)})});
  run(tree, "a.svg");
  const std::string svg = formats::read_file(path("a.svg"));
  EXPECT_NE(svg.find("<path class=\"frame\" fill=\"#FF0000\""), std::string::npos) << svg;
  EXPECT_NEAR(size_of(imported("a.svg")), 16, 1e-5);
  run(tree, "a.dxf");
  EXPECT_NEAR(size_of(imported("a.dxf")), 16, 1e-5);
  Import frame;
  frame.path = path("a.dxf");
  frame.layer = "frame";
  EXPECT_NEAR(size_of(node(frame)), 15, 1e-5);
}

TEST_F(ScadJob, SameBytesOnAnyNumberOfThreads) {
  Children balls;
  for (int n = 0; n < 6; ++n) balls.push_back(moved(1.5 * n, 0.3 * n, 0, {sphere(1, 12)}));
  const TreePtr tree = difference({unite(balls), cube(5, 1, 1)});
  std::string bytes[2];
  for (int n = 0; n < 2; ++n) {
    Diagnostics messages;
    ScadRequest request{tree, {{path("a.stl")}}};
    request.threads = n == 0 ? 1 : 4;
    run_scad(request, messages);
    bytes[n] = formats::read_file(path("a.stl"));
  }
  EXPECT_TRUE(bytes[0] == bytes[1]);
}

TEST_F(ScadJob, MissingAndBrokenImports) {
  EXPECT_TRUE(run(imported("none.stl"), "a.stl").files.empty());
  EXPECT_EQ(first_message(), "Can't open import file '" + path("none.stl") + "'");
  std::ofstream(path("open.off")) << "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 1 3\n";
  EXPECT_EQ(run(imported("open.off"), "a.stl").files.size(), 1U);  // alone it stays as it is
  EXPECT_TRUE(first_message().starts_with('"' + path("open.off") + "\" is open; it stays as it is")) << first_message();
  EXPECT_TRUE(run(unite({imported("open.off"), cube(1)}), "b.stl").files.empty());
}

TEST_F(ScadJob, CrossingShellsBecomeOne) {
  std::ostringstream text;
  text << "OFF\n8 8 0\n";
  for (const double x : {0.0, 0.25}) text << x << " 0 0\n" << x + 1 << " 0 0\n" << x << " 1 0\n" << x << " 0 1\n";
  for (const int n : {0, 4})
    text << "3 " << n << ' ' << n + 2 << ' ' << n + 1 << "\n3 " << n << ' ' << n + 1 << ' ' << n + 3 << "\n3 " << n
         << ' ' << n + 3 << ' ' << n + 2 << "\n3 " << n + 1 << ' ' << n + 2 << ' ' << n + 3 << '\n';
  std::ofstream(path("two.off")) << text.str();
  // Two tetrahedra of volume 1/6 share one of edge 3/4.
  EXPECT_NEAR(size_of(imported("two.off")), 2.0 / 6 - 0.75 * 0.75 * 0.75 / 6, 1e-9);
}

TEST_F(ScadJob, Surfaces) {
  Surface surface;
  surface.path = path("h.dat");
  // The numbers are those of OpenSCAD 2021.01.
  const std::map<std::string, double> volumes{
      {"# heights\n1 2 3\n4 5 6\n", 7}, {"5 6\n7 8\n", 6.5}, {"6 6 6\n6 6 6\n6 6 6\n", 24},
      {"0.5 1\n2 3\n", 2.125},          {"0 0\n0 0\n", 1},   {"-5 -6\n-7 -8\n", 2.5}};
  for (const auto& [heights, volume] : volumes) {
    std::ofstream(path("h.dat")) << heights;
    EXPECT_NEAR(size_of(node(surface)), volume, 1e-9) << heights;
  }
}

TEST_F(ScadJob, PiecesBecomeMadeSolids) {
  const design::SolidsRequest request = sources::solids_request(evaluated(two_parts()), "two.scad");
  ASSERT_EQ(request.solids->size(), 3U);
  EXPECT_EQ((*request.solids)[0].material, "PLA");
  EXPECT_EQ((*request.solids)[0].colour, (design::Rgba{255, 0, 0, 255}));
  EXPECT_EQ((*request.solids)[1].part, "right");
}

}  // namespace
}  // namespace ombre::compile
