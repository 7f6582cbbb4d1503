// Tests of XDMF grids, with their numbers as text and in HDF5 files.
#include <gtest/gtest.h>

#include "formats/containers/hdf5.h"
#include "formats/results/results.h"

#ifdef OMBRE_3MF

namespace ombre::formats {
namespace {

std::string item(const std::string& numbers) { return "<DataItem Format=\"XML\">" + numbers + "</DataItem>"; }

struct GridText {
  std::string grid = "GridType=\"Uniform\"", topology = "Tetrahedron", nodes = item("0 1 2 3"),
              points = item("0 0 0 1 0 0 0 2 0 0 0 3"), stress = item("1 4 6 2 5 3"),
              move = item("1 2 3 4 5 6 7 8 9 10 11 12");

  std::string text() const {
    return "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain><Grid Name=\"mesh\" " + grid +
           "><Topology TopologyType=\"" + topology + "\">" + nodes + "</Topology><Geometry GeometryType=\"XYZ\">" +
           points + "</Geometry><Attribute Name=\"displacement [mm]\" AttributeType=\"Vector\" Center=\"Node\">" +
           move + "</Attribute><Attribute Name=\"stress [MPa]\" AttributeType=\"Tensor6\" Center=\"Cell\">" + stress +
           "</Attribute></Grid></Domain></Xdmf>";
  }
};

std::optional<Results> read_grid(const GridText& grid, Diagnostics& diagnostics, const std::string& numbers = "") {
  std::optional<ResultsFile> file;
  if (!numbers.empty()) file = ResultsFile{"a.h5", numbers};
  return read_results("a.xdmf", grid.text(), {file, {}}, diagnostics);
}

std::string grid_error(const GridText& grid, const std::string& numbers = "") {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_grid(grid, diagnostics, numbers));
  return to_text(diagnostics);
}

TEST(Xdmf, NumbersAsText) {
  Diagnostics diagnostics;
  const auto results = read_grid({}, diagnostics);
  ASSERT_TRUE(results) << to_text(diagnostics);
  EXPECT_EQ(results->points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}));
  EXPECT_EQ(results->nodes, (std::vector<uint32_t>{0, 1, 2, 3}));
  ASSERT_TRUE(find_field(*results, "displacement"));
  EXPECT_EQ(find_field(*results, "displacement")->values[11], 12);
  // XDMF's order is xx, xy, xz, yy, yz, zz.
  EXPECT_EQ(find_field(*results, "stress")->values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(find_field(*results, "stress")->unit, "MPa");
}

// A triangle and a line of the surface stand before the tetrahedron.
TEST(Xdmf, MixedElementsWithoutVolumeAreLeftOut) {
  GridText mixed;
  mixed.topology = "Mixed";
  mixed.nodes = item("4 0 1 2 2 2 0 1 6 0 1 2 3");
  mixed.stress = item("9 9 9 9 9 9 8 8 8 8 8 8 1 4 6 2 5 3");
  Diagnostics diagnostics;
  const auto results = read_grid(mixed, diagnostics);
  ASSERT_TRUE(results) << to_text(diagnostics);
  EXPECT_EQ(results->nodes, (std::vector<uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(find_field(*results, "stress")->values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_NE(to_text(diagnostics).find("2 points, lines or faces of the grid are left out"), std::string::npos);
  ASSERT_EQ(results->left_out.size(), 1U);
  EXPECT_EQ(results->left_out[0].count, 2U);
}

TEST(Xdmf, CountsOfElementsMustAgree) {
  GridText mixed;
  mixed.topology = "Mixed\" NumberOfElements=\"2";
  mixed.nodes = item("6 0 1 2 3");
  EXPECT_NE(grid_error(mixed).find("the topology says that it has 2 elements, and lists 1"), std::string::npos);
}

TEST(Xdmf, PointsMayBeCountedFromOne) {
  GridText from_one;
  from_one.topology = "Tetrahedron\" BaseOffset=\"1";
  from_one.nodes = item("1 2 3 4");
  Diagnostics diagnostics;
  const auto results = read_grid(from_one, diagnostics);
  ASSERT_TRUE(results) << to_text(diagnostics);
  EXPECT_EQ(results->nodes, (std::vector<uint32_t>{0, 1, 2, 3}));
}

// ParaView writes the types as Type.
TEST(Xdmf, NewerNamesOfTypes) {
  const auto renamed = [](std::string text) {
    for (const std::string name : {"TopologyType=", "GeometryType=", "AttributeType="})
      for (size_t at = text.find(name); at != std::string::npos; at = text.find(name))
        text.replace(at, name.size(), "Type=");
    return text;
  };
  Diagnostics diagnostics;
  const auto results = read_results("a.xdmf", renamed(GridText().text()), {}, diagnostics);
  ASSERT_TRUE(results) << to_text(diagnostics);
  EXPECT_EQ(find_field(*results, "stress")->values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  std::string flat = renamed(GridText().text());
  flat.replace(flat.find("\"XYZ\""), 5, "\"XY\"");
  EXPECT_FALSE(read_results("a.xdmf", flat, {}, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("expected the geometry XYZ"), std::string::npos);
}

TEST(Xdmf, GridsOfFacesAreTheirPoints) {
  GridText faces;
  faces.topology = "Triangle";
  faces.nodes = item("0 1 2 1 2 3");
  faces.stress = item("1 4 6 2 5 3 1 4 6 2 5 3");
  faces.move = item("1 1 1 1 1 1 1 1 1 1 2 2 2 2 2 2 2 2 2 2 3 3 3 3 3 3 3 3 3 3 4 4 4 4 4 4 4 4 4 4");
  Diagnostics diagnostics;
  const auto results = read_grid(faces, diagnostics);
  ASSERT_TRUE(results) << to_text(diagnostics);
  EXPECT_TRUE(results->kinds.empty());
  EXPECT_EQ(results->points.size(), 4U);
  EXPECT_NE(to_text(diagnostics).find("2 points, lines or faces"), std::string::npos);
  EXPECT_NE(to_text(diagnostics).find("1 fields of more than 9 numbers are left out"), std::string::npos);
}

// A grid with its mesh, the value of a field at its first node and a time.
std::string step_of(const std::string& mesh, int value, const std::string& time) {
  return "<Grid Name=\"s\" GridType=\"Uniform\">" + mesh + "<Time Value=\"" + time +
         "\"/><Attribute Name=\"t\" Center=\"Node\">" + item(std::to_string(value) + " 0 0 0") + "</Attribute></Grid>";
}

std::string series_of(const std::string& before, const std::string& steps) {
  return "<Xdmf xmlns:xi=\"http://www.w3.org/2001/XInclude\"><Domain>" + before +
         "<Grid Name=\"series\" GridType=\"Collection\" CollectionType=\"Temporal\">" + steps +
         "</Grid></Domain></Xdmf>";
}

const std::string tetrahedron = "<Topology TopologyType=\"Tetrahedron\">" + item("0 1 2 3") +
                                "</Topology><Geometry GeometryType=\"XYZ\">" + item("0 0 0 1 0 0 0 2 0 0 0 3") +
                                "</Geometry>";

TEST(Xdmf, StepsOfACollection) {
  const std::string series =
      series_of("", step_of(tetrahedron, 5, "0") + step_of(tetrahedron, 6, "0.5") + step_of(tetrahedron, 7, "2"));
  for (const auto& [step, value] : std::vector<std::pair<uint64_t, double>>{{0, 7}, {1, 5}, {2, 6}, {3, 7}}) {
    Diagnostics diagnostics;
    const auto results = read_results("a.xdmf", series, {{}, {}, step}, diagnostics);
    ASSERT_TRUE(results) << to_text(diagnostics);
    EXPECT_EQ(find_field(*results, "t")->values[0], value);
    EXPECT_EQ(results->kinds.size(), 1U);
  }
  Diagnostics diagnostics;
  EXPECT_FALSE(read_results("a.xdmf", series, {{}, {}, 4}, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("no step 4; the file has 3 steps: 1 (time 0), 2 (time 0.5), 3 (time 2)"),
            std::string::npos)
      << to_text(diagnostics);
}

// meshio writes series with the mesh as a grid of its own, FEniCS with the mesh in the first step.
TEST(Xdmf, StepsThatIncludeTheirMesh) {
  const auto include = [](const std::string& grid) {
    return "<xi:include xpointer=\"xpointer(//Grid[@Name=&quot;" + grid + "/*[self::Topology or self::Geometry])\"/>";
  };
  const std::string own = include("mesh&quot;]"), of_first = include("series&quot;]/Grid[1]");
  for (const std::string& series : {series_of("<Grid Name=\"mesh\" GridType=\"Uniform\">" + tetrahedron + "</Grid>",
                                              step_of(own, 1, "0") + step_of(own, 2, "1")),
                                    series_of("", step_of(tetrahedron, 1, "0") + step_of(of_first, 2, "1"))}) {
    Diagnostics diagnostics;
    const auto results = read_results("a.xdmf", series, {}, diagnostics);
    ASSERT_TRUE(results) << to_text(diagnostics);
    EXPECT_EQ(results->points.size(), 4U);
    EXPECT_EQ(find_field(*results, "t")->values[0], 2);
  }
  Diagnostics diagnostics;
  EXPECT_FALSE(read_results("a.xdmf", series_of("", step_of(include("other&quot;]"), 1, "0")), {}, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("the mesh that this include names is not found"), std::string::npos);
}

TEST(Xdmf, WhatIsWrongIsSaid) {
  GridText wedge, short_nodes, far, series, short_field, without, odd;
  wedge.topology = "Wedge_15";
  EXPECT_NE(grid_error(wedge).find("\"Wedge_15\" are not read"), std::string::npos);
  GridText mixed;
  mixed.topology = "Mixed";
  mixed.nodes = item("40 0 1 2 3 0 1");
  EXPECT_NE(grid_error(mixed).find("element 0 is of XDMF's type 40"), std::string::npos);
  mixed.nodes = item("6 0 1 2 3 6 0 1");
  EXPECT_NE(grid_error(mixed).find("has not the 4 nodes of its type"), std::string::npos);
  short_nodes.nodes = item("0 1 2");
  EXPECT_NE(grid_error(short_nodes).find("expected 4 nodes for each element, found 3"), std::string::npos);
  far.nodes = item("0 1 2 4");
  EXPECT_NE(grid_error(far).find("names point 4; there are 4"), std::string::npos);
  series.grid = "GridType=\"Collection\" CollectionType=\"Spatial\"";
  EXPECT_NE(grid_error(series).find("save each step"), std::string::npos);
  short_field.move = item("1 2 3");
  EXPECT_NE(grid_error(short_field).find("3 numbers for 4 nodes"), std::string::npos);
  without.points = "<DataItem Format=\"HDF\">a.h5:/Mesh/geometry</DataItem>";
  EXPECT_NE(grid_error(without).find("name it by values="), std::string::npos);
  odd.points = "<DataItem Format=\"Binary\">a.bin</DataItem>";
  EXPECT_NE(grid_error(odd).find("found \"Binary\""), std::string::npos);
}

#ifdef OMBRE_HDF5

TEST(Xdmf, NumbersInHdf5) {
  const std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3};
  const std::vector<int64_t> nodes{0, 1, 2, 3};
  const std::vector<float> wide{1, 2, 3, 4};
  const std::vector<Hdf5Array> arrays{{"/Mesh/geometry", Hdf5Array::Kind::float64, {4, 3}, points.data()},
                                      {"/Mesh/nodes", Hdf5Array::Kind::int64, {1, 4}, nodes.data()},
                                      {"/short", Hdf5Array::Kind::float32, {4}, wide.data()}};
  const std::string bytes = hdf5_file(arrays);
  EXPECT_EQ(hdf5_file(arrays), bytes);
  const auto file = open_hdf5(bytes);
  ASSERT_TRUE(file);
  std::string problem;
  const auto numbers = file->numbers("/short", problem), rows = file->numbers("/Mesh/geometry", problem, {1, 2});
  ASSERT_TRUE(numbers && rows);
  EXPECT_EQ(numbers->sizes, std::vector<uint64_t>{4});
  EXPECT_EQ(numbers->values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(rows->sizes, (std::vector<uint64_t>{2, 3}));
  EXPECT_EQ(rows->values, (std::vector<double>{1, 0, 0, 0, 2, 0}));
  EXPECT_EQ(file->arrays_in("/Mesh"), (std::vector<std::string>{"geometry", "nodes"}));
  EXPECT_FALSE(file->numbers("/Mesh/none", problem));
  EXPECT_FALSE(file->numbers("/Mesh", problem));
  EXPECT_EQ(problem, "");
  EXPECT_FALSE(file->numbers("/Mesh/geometry", problem, {3, 2}));
  EXPECT_EQ(problem, "it has 4 rows");
  EXPECT_FALSE(open_hdf5("no numbers"));

  GridText grid;
  grid.points = "<DataItem Format=\"HDF\">other name.h5:/Mesh/geometry</DataItem>";
  grid.nodes = "<DataItem Format=\"HDF\">other name.h5:/Mesh/nodes</DataItem>";
  Diagnostics diagnostics;
  const auto results = read_grid(grid, diagnostics, bytes);
  ASSERT_TRUE(results) << to_text(diagnostics);
  EXPECT_EQ(results->points[3], (Vec3{0, 0, 3}));
  grid.points = "<DataItem Format=\"HDF\">a.h5:/Mesh/place</DataItem>";
  EXPECT_NE(grid_error(grid, bytes).find("has no numbers at \"/Mesh/place\""), std::string::npos);
  grid.points = "<DataItem Format=\"HDF\">b.h5:/Mesh/geometry</DataItem>";
  EXPECT_NE(grid_error(grid, bytes).find("several files: \"b.h5\" and \"other name.h5\""), std::string::npos);
  EXPECT_NE(grid_error(grid, bytes.substr(0, 100)).find("no file of HDF5"), std::string::npos);
  EXPECT_NE(grid_error(grid, "no numbers").find("no file of HDF5"), std::string::npos);
}

#endif

}  // namespace
}  // namespace ombre::formats

#endif
