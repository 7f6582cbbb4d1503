// Tests of polyhedra in VTK's unstructured grids.
#include <gtest/gtest.h>

#include <cmath>

#include "formats/results/results.h"

#ifdef OMBRE_3MF

namespace ombre::formats {
namespace {

std::string array(const std::string& name, const std::string& numbers, const std::string& components = "1") {
  return "<DataArray type=\"Float64\" Name=\"" + name + "\" NumberOfComponents=\"" + components +
         "\" format=\"ascii\">" + numbers + "</DataArray>";
}

// Two cubes of side 1, one above the other, of which the lower one is a polyhedron; x + 2y + 4z at the nodes.
std::string cubes(const std::string& faces) {
  return "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"12\" NumberOfCells=\"2\">"
         "<PointData>" +
         array("t", "0 1 3 2 4 5 7 6 8 9 11 10") + "</PointData><CellData>" + array("c", "10 20") +
         "</CellData><Points>" +
         array("Points", "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1 0 0 2 1 0 2 1 1 2 0 1 2", "3") +
         "</Points><Cells>" + array("connectivity", "0 1 2 3 4 5 6 7 4 5 6 7 8 9 10 11") + array("offsets", "8 16") +
         array("types", "42 12") + faces + "</Cells></Piece></UnstructuredGrid></VTKFile>";
}
const std::string sides = " 4 0 3 2 1 4 4 5 6 7 4 0 1 5 4 4 1 2 6 5 4 2 3 7 6 4 3 0 4 7";
const std::string old_faces = array("faces", "6" + sides) + array("faceoffsets", "31 -1");
const std::string new_faces = array("face_connectivity", "0 3 2 1 4 5 6 7 0 1 5 4 1 2 6 5 2 3 7 6 3 0 4 7") +
                              array("face_offsets", "4 8 12 16 20 24") + array("polyhedron_to_faces", "0 1 2 3 4 5") +
                              array("polyhedron_offsets", "6 6");

double volume_of_tetrahedra(const Results& results) {
  double sum = 0;
  for (size_t n = 0; n < results.kinds.size(); ++n) {
    if (results.kinds[n] != ElementKind::tetrahedron4) continue;
    const uint32_t* const at = &results.nodes[results.first[n]];
    const Vec3 a = results.points[at[0]];
    sum += dot(cross(results.points[at[1]] - a, results.points[at[2]] - a), results.points[at[3]] - a) / 6;
  }
  return sum;
}

// Both ways in which VTK has written faces.
TEST(Polyhedra, AreFilledByTetrahedra) {
  for (const std::string& faces : {old_faces, new_faces}) {
    Diagnostics diagnostics;
    const auto results = read_results("a.vtu", cubes(faces), {}, diagnostics);
    ASSERT_TRUE(results) << to_text(diagnostics);
    EXPECT_EQ(to_text(diagnostics), "");
    EXPECT_EQ(results->kinds.size(), 25U);
    EXPECT_EQ(results->points.size(), 12U + 1 + 6);
    EXPECT_NEAR(volume_of_tetrahedra(*results), 1, 1e-12);
    // A field that is linear in space keeps its values in the middle of the cell and of its sides.
    const std::vector<double>& t = find_field(*results, "t")->values;
    ASSERT_EQ(t.size(), results->points.size());
    for (size_t n = 0; n < t.size(); ++n) {
      const Vec3 p = results->points[n];
      EXPECT_NEAR(t[n], p.x + 2 * p.y + 4 * p.z, 1e-12) << n;
    }
    std::vector<double> expected(24, 10);
    expected.push_back(20);
    EXPECT_EQ(find_field(*results, "c")->values, expected);
  }
}

TEST(Polyhedra, WrongFacesAreReported) {
  const auto said = [](const std::string& faces) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_results("a.vtu", cubes(faces), {}, diagnostics)) << faces;
    return to_text(diagnostics);
  };
  EXPECT_NE(said("").find("expected an array \"faces\""), std::string::npos);
  EXPECT_NE(said(array("faces", "7" + sides) + array("faceoffsets", "31 -1")).find("has not the faces"),
            std::string::npos);
  EXPECT_NE(said(array("faces", "6" + sides) + array("faceoffsets", "1e300 -1")).find("beyond the file"),
            std::string::npos);
  EXPECT_NE(
      said(array("faces", "4 3 0 1 2 3 0 1 3 3 1 2 3 3 0 2 99") + array("faceoffsets", "17 -1")).find("names point 99"),
      std::string::npos);
  EXPECT_NE(said(array("face_connectivity", "0 1 2 3") + array("face_offsets", "4") +
                 array("polyhedron_to_faces", "0 0 0 0") + array("polyhedron_offsets", "4 4"))
                .find("more than two polyhedra"),
            std::string::npos);
}

}  // namespace
}  // namespace ombre::formats

#endif
