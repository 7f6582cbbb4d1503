// Tests of collections of steps and parts of VTK's unstructured grids, and of grids in pieces.
#include <gtest/gtest.h>

#include "formats/results/results.h"

#ifdef OMBRE_3MF

namespace ombre::formats {
namespace {

std::string typed_array(const std::string& type, const std::string& name, const std::string& numbers) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         (name == "Points" ? "3" : "1") + "\" format=\"ascii\">" + numbers + "</DataArray>";
}

// One tetrahedron that begins at x, with a value at its nodes.
std::string grid_at(int x, int value) {
  const std::string a = std::to_string(x), b = std::to_string(x + 1), v = ' ' + std::to_string(value);
  return "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid><Piece "
         "NumberOfPoints=\"4\" NumberOfCells=\"1\"><PointData>" +
         typed_array("Float64", "t", v + v + v + v) + "</PointData><Points>" +
         typed_array("Float64", "Points", a + " 0 0 " + b + " 0 0 " + a + " 1 0 " + a + " 0 1") + "</Points><Cells>" +
         typed_array("Int64", "connectivity", "0 1 2 3") + typed_array("Int64", "offsets", "4") +
         typed_array("UInt8", "types", "10") + "</Cells></Piece></UnstructuredGrid></VTKFile>";
}

std::string collection_of(const std::string& sets) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\"><Collection>" + sets +
         "</Collection></VTKFile>";
}
std::string set_of(const std::string& time, const std::string& file) {
  return "<DataSet timestep=\"" + time + "\" group=\"\" part=\"0\" file=\"" + file + "\"/>\n";
}
std::string pieces_of(const std::string& pieces) {
  return "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid GhostLevel=\"0\">" + pieces +
         "</PUnstructuredGrid></VTKFile>";
}

// Steps stand in the order of their times, not of the file; the second has two parts, one of them in pieces.
TEST(Collections, StepsAndPartsAreJoined) {
  const std::string pvd = collection_of(set_of("10", "b.vtu") + set_of("2", "a.vtu") + set_of("10", "sub/c.pvtu"));
  const std::string pvtu = pieces_of("<Piece Source=\"d.vtu\"/><Piece Source='e.vtu'/>");
  EXPECT_EQ(files_named_in("a.pvd", pvd), (std::vector<std::string>{"b.vtu", "sub/c.pvtu"}));
  EXPECT_EQ(files_named_in("a.pvd", pvd, 1), (std::vector<std::string>{"a.vtu"}));
  EXPECT_TRUE(files_named_in("a.pvd", pvd, 3).empty());
  EXPECT_EQ(files_named_in("x/sub/c.pvtu", pvtu, 0, "sub/c.pvtu"),
            (std::vector<std::string>{"sub/d.vtu", "sub/e.vtu"}));
  EXPECT_TRUE(may_name_files("a.pvd") && may_name_files("a.pvtu") && !may_name_files("a.vtu"));
  const std::string a = grid_at(0, 1), b = grid_at(0, 2), d = grid_at(1, 3), e = grid_at(2, 4);
  const std::string marked = "\xEF\xBB\xBF" + pvtu;  // by a byte order mark
  const std::vector<ResultsFile> files{{"b.vtu", b, "b.vtu"},
                                       {"a.vtu", a, "a.vtu"},
                                       {"sub/c.pvtu", marked, "sub/c.pvtu"},
                                       {"sub/d.vtu", d, "sub/d.vtu"},
                                       {"sub/e.vtu", e, "sub/e.vtu"}};
  Diagnostics diagnostics;
  const auto last = read_results("a.pvd", pvd, {{}, files}, diagnostics);
  ASSERT_TRUE(last) << to_text(diagnostics);
  EXPECT_EQ(last->nodes, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(last->first, (std::vector<uint64_t>{0, 4, 8}));
  EXPECT_EQ(last->points[9], (Vec3{3, 0, 0}));
  EXPECT_EQ(find_field(*last, "t")->values, (std::vector<double>{2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4}));
  EXPECT_EQ(last->step_times, (std::vector<std::string>{"2", "10"}));
  EXPECT_EQ(last->step, 2U);
  const auto first = read_results("a.pvd", pvd, {{}, files, 1}, diagnostics);
  ASSERT_TRUE(first) << to_text(diagnostics);
  EXPECT_EQ(find_field(*first, "t")->values, (std::vector<double>{1, 1, 1, 1}));
  EXPECT_FALSE(read_results("a.pvd", pvd, {{}, files, 3}, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("2 steps: 1 (time 2), 2 (time 10)"), std::string::npos) << to_text(diagnostics);
}

TEST(Collections, CellsOfOtherPiecesAreLeftOut) {
  std::string ghost = grid_at(1, 1);
  ghost.insert(ghost.find("<Points>"), "<CellData>" + typed_array("UInt8", "vtkGhostType", "1") + "</CellData>");
  const std::string own = grid_at(0, 2), pvtu = pieces_of("<Piece Source=\"a.vtu\"/><Piece Source=\"b.vtu\"/>");
  Diagnostics diagnostics;
  const auto results =
      read_results("a.pvtu", pvtu, {{}, {{"a.vtu", own, "a.vtu"}, {"b.vtu", ghost, "b.vtu"}}}, diagnostics);
  ASSERT_TRUE(results) << to_text(diagnostics);
  EXPECT_EQ(results->nodes, (std::vector<uint32_t>{0, 1, 2, 3}));
  EXPECT_NE(to_text(diagnostics).find("1 cells that are hidden, or belong to another piece, are left out"),
            std::string::npos);
}

TEST(Collections, MissingFilesAreNamed) {
  const auto said = [](const std::string& name, const std::string& text, const std::vector<ResultsFile>& files) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_results(name, text, {{}, files}, diagnostics));
    return to_text(diagnostics);
  };
  EXPECT_NE(said("a.pvd", collection_of(set_of("0", "a.vtu")), {}).find("\"a.vtu\" that is named here is not there"),
            std::string::npos);
  EXPECT_NE(said("a.pvd", collection_of(""), {}).find("no steps"), std::string::npos);
  EXPECT_NE(said("a.pvtu", pieces_of(""), {}).find("the file holds no points"), std::string::npos);
  EXPECT_NE(said("a.pvtu", pieces_of("<Piece/>"), {}).find("Source"), std::string::npos);
  const std::string own = collection_of(set_of("0", "a.pvd"));
  EXPECT_NE(said("a.pvd", own, {{"a.pvd", own, "a.pvd"}}).find("no unstructured grid"), std::string::npos);
}

}  // namespace
}  // namespace ombre::formats

#endif
