#include "formats/results/results.h"

#include <gtest/gtest.h>

#include "formats/containers/base64.h"

#ifdef OMBRE_3MF

namespace ombre::formats {
namespace {

// Returns one tetrahedron as text, with a value for each node and for the element.
std::string vtu_of_tetrahedron(const std::string& header, const std::string& point_array,
                               const std::string& type = "10") {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" " + header +
         "><UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n<Points>" + point_array +
         "</Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
         "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray>"
         "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" +
         type +
         "</DataArray></Cells><PointData><DataArray type=\"Float64\" Name=\"move [mm]\" NumberOfComponents=\"3\" "
         "format=\"ascii\">1 2 3 4 5 6 7 8 9 10 11 12</DataArray></PointData><CellData><DataArray type=\"Float32\" "
         "Name=\"stress [MPa]\" NumberOfComponents=\"6\" format=\"ascii\">10 0 0 0 0 0</DataArray></CellData>"
         "</Piece></UnstructuredGrid></VTKFile>";
}
const std::string text_points =
    "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 2 0 0 0 3e0</DataArray>";
std::string binary_points(const std::string& type, const std::string& bytes) {
  return "<DataArray type=\"" + type + "\" NumberOfComponents=\"3\" format=\"binary\">" + bytes + "</DataArray>";
}

Results read_good(const std::string& file) {
  Diagnostics diagnostics;
  auto results = read_results("a.vtu", file, {}, diagnostics);
  EXPECT_TRUE(results) << to_text(diagnostics);
  return results.value_or(Results{});
}
std::string error_of(const std::string& file) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_results("a.vtu", file, {}, diagnostics));
  return to_text(diagnostics);
}
const std::vector<Vec3> cube_corners{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};

}  // namespace

TEST(Results, VtuAsText) {
  const Results results = read_good(vtu_of_tetrahedron("", text_points));
  EXPECT_EQ(results.points, cube_corners);
  EXPECT_EQ(results.nodes, (std::vector<uint32_t>{0, 1, 2, 3}));
  ASSERT_EQ(results.fields.size(), 3U);
  EXPECT_EQ(results.fields[0].name, "move");
  EXPECT_EQ(results.fields[0].unit, "mm");
  EXPECT_EQ(results.fields[0].values[11], 12);
  EXPECT_TRUE(results.fields[1].is_of_elements);
  EXPECT_EQ(find_field(results, "Stress"), &results.fields[1]);
  EXPECT_EQ(find_field(results, "mov"), &results.fields[0]);
  EXPECT_EQ(find_field(results, "none"), nullptr);
}

// Tension of 10 MPa along x has a von Mises stress of 10 MPa.
TEST(Results, VonMisesIsAddedToStresses) {
  const Results results = read_good(vtu_of_tetrahedron("", text_points));
  ASSERT_TRUE(find_field(results, "von_mises"));
  EXPECT_EQ(find_field(results, "von_mises")->values, std::vector<double>{10});
  const std::array<double, 6> shear{0, 0, 0, 2, 0, 0};
  EXPECT_DOUBLE_EQ(von_mises(shear.data()), 2 * std::sqrt(3));
}

// The arrays were written by Python's struct, zlib and base64.
TEST(Results, VtuInBase64) {
  const std::string floats = "MAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAABAAAAAAAAAAAAAAAAAAABAQA==";
  EXPECT_EQ(read_good(vtu_of_tetrahedron("", binary_points("Float32", floats))).points, cube_corners);
  const std::string big = "AAAAAAAAADAAAAAAAAAAAAAAAAA/gAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAAEBAAAA=";
  EXPECT_EQ(
      read_good(vtu_of_tetrahedron("byte_order=\"BigEndian\" header_type=\"UInt64\"", binary_points("Float32", big)))
          .points,
      cube_corners);
}

TEST(Results, VtuPackedInBlocks) {
  const std::string packed = "AgAAACAAAAAQAAAAEQAAAA0AAAA=eJxjYEAGDfYMqMABAA2PAQB4nGNgQAYODgAA0ACB";
  EXPECT_EQ(
      read_good(vtu_of_tetrahedron("compressor=\"vtkZLibDataCompressor\"", binary_points("Float32", packed))).points,
      cube_corners);
  const std::string cut = packed.substr(0, packed.size() - 8);
  EXPECT_NE(error_of(vtu_of_tetrahedron("compressor=\"vtkZLibDataCompressor\"", binary_points("Float32", cut)))
                .find("cut off"),
            std::string::npos);
}

// The arrays were packed by Python's lz4 and lzma in two blocks, as VTK packs them. Builds without a library name it.
TEST(Results, VtuPackedByLz4AndLzma) {
  const std::array<std::array<std::string, 3>, 2> cases{
      {{"vtkLZ4DataCompressor", "AgAAACAAAAAQAAAADwAAAAoAAAA=GQABACeAPw8AUAAAAABAFgABAFAAAABAQA==", "OMBRE_LZ4"},
       {"vtkLZMADataCompressor",
        "AgAAACAAAAAQAAAARAAAAEAAAAA=/Td6WFoAAAFpIt42AgAhARYAAAB0L+Wj4AAfAAtdAABszlCv9wHmXiAAAADuas0+AAEjIILi"
        "QaWQQpkNAQAAAAABWVr9N3pYWgAAAWki3jYCACEBFgAAAHQv5aPgAA8ACF0AAGzGUN/wAAAAwEUeagABIBDtgbWokEKZDQEAAAAAAVla",
        "OMBRE_LZMA"}}};
  for (const auto& [compressor, packed, option] : cases) {
    const std::string header = "compressor=\"" + compressor + '"';
    Diagnostics diagnostics;
    const auto results =
        read_results("a.vtu", vtu_of_tetrahedron(header, binary_points("Float32", packed)), {}, diagnostics);
    if (to_text(diagnostics).find(option) != std::string::npos) continue;
    ASSERT_TRUE(results) << to_text(diagnostics);
    EXPECT_EQ(results->points, cube_corners);
    std::string wrong = packed;
    wrong[28] = 'Z';  // in the head of the first block
    EXPECT_NE(error_of(vtu_of_tetrahedron(header, binary_points("Float32", wrong))).find("damaged or cut off"),
              std::string::npos);
  }
  const std::string unknown = vtu_of_tetrahedron("compressor=\"vtkOther\"", binary_points("Float32", cases[0][1]));
  EXPECT_NE(error_of(unknown).find("numbers packed by \"vtkOther\" are not read"), std::string::npos);
}

TEST(Results, Base64) {
  EXPECT_EQ(from_base64("TWFu TWE=\n"), "ManMa");
  EXPECT_EQ(from_base64("TQ=="), "M");
  for (const char* wrong : {"TQ=", "T?==", "TQ==TQ=a", "===="}) EXPECT_FALSE(from_base64(wrong)) << wrong;
}

TEST(Results, WhatIsWrongIsSaid) {
  const auto says = [](const std::string& file, const std::string& what) {
    EXPECT_NE(error_of(file).find(what), std::string::npos) << error_of(file);
  };
  const std::string good = vtu_of_tetrahedron("", text_points);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = good;
    changed.replace(changed.find(from), from.size(), to);
    return changed;
  };
  says("<nothing", "XML");
  says(with("UnstructuredGrid", "ImageData"), "no unstructured grid");
  says(with(">10<", ">26<"), "type 26");
  says(with(">10<", ">12<"), "8 nodes");
  says(with("0 1 2 3", "0 1 2 4"), "names point 4");
  says(with("0 1 2 3", "0 1 2"), "cut off");
  says(with("3e0", "nan"), "not finite");
  says(with("3e0", ""), "cut off");
  says(with("NumberOfPoints=\"4\"", "NumberOfPoints=\"400000000\""), "more points");
  says(with("Float64", "Float16"), "Float16");
  for (size_t size = 0; size < good.size(); size += 37) error_of(good.substr(0, size));
}

}  // namespace ombre::formats

#endif

namespace ombre::formats {
namespace {

// A bar of one quadratic brick in CalculiX's format, without the columns that are not read.
const std::string bar = [] {
  std::string text = "    1C\n    2C                            20                                     1\n";
  const char* const nodes[20] = {"0 0 0",  "1 0 0",  "1 1 0",  "0 1 0",  "0 0 2",  "1 0 2",  "1 1 2",
                                 "0 1 2",  ".5 0 0", "1 .5 0", ".5 1 0", "0 .5 0", ".5 0 2", "1 .5 2",
                                 ".5 1 2", "0 .5 2", "0 0 1",  "1 0 1",  "1 1 1",  "0 1 1"};
  const auto padded = [](std::string word, size_t size) { return std::string(size - word.size(), ' ') + word; };
  const auto line = [&](int n, const std::string& x, const std::string& y, const std::string& z) {
    return " -1" + padded(std::to_string(n), 10) + padded(x, 12) + padded(y, 12) + padded(z, 12) + "\n";
  };
  std::string moves;
  for (int n = 0; n < 20; ++n) {
    const std::string all = nodes[n];
    const size_t a = all.find(' '), b = all.rfind(' ');
    text += line(n + 1, all.substr(0, a), all.substr(a + 1, b - a - 1), all.substr(b + 1));
    moves += line(n + 1, "1.00000-101", all.substr(b + 1), "-" + std::to_string(n + 1) + ".0E-01");
  }
  text += " -3\n    3C                             1                                     1\n";
  text += " -1         1    4    0    1\n -2         1         2         3         4         5         6         7";
  text += "         8         9        10\n -2        11        12        17        18        19        20        13";
  text += "        14        15        16\n -3\n";
  const std::string head =
      "  100CL  101 1.000000000          20                     0    1           1\n -4  DISP        4    1\n"
      " -5  D1          1    2    1    0\n -5  D2          1    2    2    0\n -5  D3          1    2    3    0\n"
      " -5  ALL         1    2    0    0    1ALL\n";
  // The file has two steps with different values.
  std::string first = moves;
  for (size_t at = first.find("1.00000-101"); at != std::string::npos; at = first.find("1.00000-101"))
    first.replace(at, 11, "7.00000E+00");
  return text + head + first + " -3\n" + head + moves + " -3\n 9999\n";
}();

const std::string deck =
    "*Heading\n** a comment\n*NODE, NSET=ALL\n 1, 0,0,0\n 5, 1,0,0\n7, 0,2,0\n9,0,0,3\n10,1,1,1\n"
    "*ELEMENT, TYPE=C3D4H, ELSET=A\n3, 1, 5,\n7, 9\n4, 5, 7, 9, 10\n*ELEMENT, TYPE=S3\n8, 1, 5, 7\n"
    "*NODE FILE\nU\n";

std::optional<Results> read_with(const std::string& text, const std::string& table, std::string& said) {
  Diagnostics diagnostics;
  std::optional<ResultsFile> values;
  if (!table.empty()) values = {"a.csv", table};
  auto results = read_results("a.inp", text, {values, {}}, diagnostics);
  said = to_text(diagnostics);
  return results;
}

}  // namespace

TEST(Results, FrdOfCalculix) {
  Diagnostics diagnostics;
  const auto results = read_results("a.frd", bar, {}, diagnostics);
  ASSERT_TRUE(results) << to_text(diagnostics);
  ASSERT_EQ(results->kinds, std::vector<ElementKind>{ElementKind::brick20});
  // Nodes are in the order of C3D20: upper edges, then vertical ones.
  EXPECT_EQ(results->points[results->nodes[12]], (Vec3{0.5, 0, 2}));
  EXPECT_EQ(results->points[results->nodes[16]], (Vec3{0, 0, 1}));
  const ResultField* moves = find_field(*results, "displacement");
  ASSERT_TRUE(moves && moves->components == 3);
  EXPECT_EQ(moves->values[0], 1e-101);  // value of the last step
  EXPECT_EQ(moves->values[3 * 4 + 1], 2);
  EXPECT_EQ(moves->values[59], -2);
  // A field without values is ignored.
  const std::string empty = bar.substr(0, bar.find("  100CL")) +
                            "  100CL  101 1.000000000          20                     0    1           1\n"
                            " -4  DISP        4    1\n -5  D1          1    2    1    0\n -3\n 9999\n";
  const auto without = read_results("a.frd", empty, {}, diagnostics);
  ASSERT_TRUE(without);
  EXPECT_TRUE(without->fields.empty());
  for (size_t size = 0; size < bar.size(); size += 101) read_results("a.frd", bar.substr(0, size), {}, diagnostics);
}

TEST(Results, OtherElementsOfCalculix) {
  const auto with = [](int type, const std::string& nodes) {
    std::string text = "    1C\n    2C\n";
    int n = 0;
    for (const char* at : {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 0 1", "0 1 1"}) {
      const std::string p = at;
      text += " -1         " + std::to_string(++n);
      for (const char c : {p[0], p[2], p[4]}) text += std::string(" ") + c + ".00000E+00";
      text += "\n";
    }
    return text + " -3\n    3C\n -1         1    " + std::to_string(type) + "    0    1\n -2" + nodes +
           "\n -3\n 9999\n";
  };
  const std::string six = "         1         2         3         4         5         6";
  Diagnostics diagnostics;
  const auto wedge = read_results("a.frd", with(2, six), {}, diagnostics);
  ASSERT_TRUE(wedge) << to_text(diagnostics);
  EXPECT_EQ(wedge->kinds, std::vector<ElementKind>{ElementKind::wedge6});
  const auto shell = read_results("a.frd", with(8, six), {}, diagnostics);
  ASSERT_TRUE(shell);
  EXPECT_TRUE(shell->kinds.empty());
  EXPECT_NE(to_text(diagnostics).find("1 shells and beams are left out"), std::string::npos);
  EXPECT_FALSE(read_results("a.frd", with(5, six), {}, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("elements of the type 5 are not read"), std::string::npos);
}

TEST(Results, StepsOfCalculix) {
  const auto block = [](const std::string& time, int step, const std::string& value) {
    std::string number = std::to_string(step);
    number.insert(0, 5 - number.size(), ' ');
    return "  100CL  101" + time + "           1                     0" + number +
           "           1\n -4  NDTEMP      1    1\n -5  T           1    1    0    0\n -1         1" + value +
           "\n -3\n";
  };
  const std::string frd =
      "    1C\n    2C                             1                                     1\n"
      " -1         1 0.00000E+00 0.00000E+00 0.00000E+00\n -3\n" +
      block(" 2.50000E-01", 1, " 3.00000E+00") + block(" 1.00000E+00", 2, " 4.00000E+00") + " 9999\n";
  for (const auto& [step, value] : std::vector<std::pair<uint64_t, double>>{{0, 4}, {1, 3}, {2, 4}}) {
    Diagnostics diagnostics;
    const auto results = read_results("a.frd", frd, {{}, {}, step}, diagnostics);
    ASSERT_TRUE(results) << to_text(diagnostics);
    EXPECT_EQ(find_field(*results, "temperature")->values, std::vector<double>{value});
    // Without a choice fields may be of several steps, so each says its own.
    EXPECT_EQ(results->step_times, (std::vector<std::string>{"2.50000E-01", "1.00000E+00"}));
    EXPECT_EQ(results->step, step);
    EXPECT_EQ(find_field(*results, "temperature")->step, step == 0 ? 2 : step);
  }
  Diagnostics diagnostics;
  EXPECT_FALSE(read_results("a.frd", frd, {{}, {}, 3}, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("2 steps: 1 (time 2.50000E-01), 2 (time 1.00000E+00)"), std::string::npos);
  EXPECT_FALSE(read_results("a.csv", "x,y,z,t\n0,0,0,1\n", {{}, {}, 2}, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("there is no step 2; the file has one step"), std::string::npos);
}

TEST(Results, DecksWithTables) {
  std::string said;
  const auto results = read_with(deck,
                                 "node, dx, dy, dz, S11, S22, S33, S12, S13, S23, T [K]\n"
                                 "9, 1,2,3, 10,20,30,40,50,60, 300\n5, 4,5,6, 0,0,0,0,0,0, 301\n"
                                 "1,0,0,0, 0,0,0,0,0,0, 1\n7,0,0,0, 0,0,0,0,0,0, 1\n10,0,0,0, 0,0,0,0,0,0, 1\n",
                                 said);
  ASSERT_TRUE(results) << said;
  EXPECT_NE(said.find("1 shells without a thickness"), std::string::npos) << said;
  EXPECT_EQ(results->nodes, (std::vector<uint32_t>{0, 1, 2, 3, 1, 2, 3, 4}));
  ASSERT_EQ(results->fields.size(), 4U);
  EXPECT_EQ(results->fields[0].name, "displacement");
  EXPECT_EQ(results->fields[0].values[3 * 3 + 2], 3);
  const auto& stress = results->fields[1];
  EXPECT_EQ(std::vector<double>(stress.values.begin() + 18, stress.values.begin() + 24),
            (std::vector<double>{10, 20, 30, 40, 60, 50}));  // xx, yy, zz, xy, yz, zx
  EXPECT_EQ(results->fields[2].unit, "K");
  EXPECT_EQ(results->fields[2].values[1], 301);
}

TEST(Results, TablesOfElementsAndWithoutNames) {
  std::string said;
  auto results = read_with(deck, "element;density\n4;0.5\n3;0.25\n", said);
  ASSERT_TRUE(results) << said;
  EXPECT_TRUE(results->fields[0].is_of_elements);
  EXPECT_EQ(results->fields[0].values, (std::vector<double>{0.25, 0.5}));
  results = read_with(deck, "1,0,0,1\n5,0,0,2\n7,0,0,3\n9,0,0,4\n10,0,0,5\n", said);
  ASSERT_TRUE(results) << said;
  EXPECT_EQ(results->fields[0].name, "displacement");
}

TEST(Results, WrongDecksAndTablesAreReported) {
  const auto says = [](const std::string& text, const std::string& table, const std::string& what) {
    std::string said;
    EXPECT_FALSE(read_with(text, table, said));
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  const auto with = [](const std::string& from, const std::string& to) {
    std::string changed = deck;
    changed.replace(changed.find(from), from.size(), to);
    return changed;
  };
  says(with("7, 0,2,0", "1, 0,2,0"), "", "a.inp:6:1: error: node 1 comes twice");
  says(with("7, 9\n", "77, 9\n"), "", "names node 77");
  says(with("4, 5, 7, 9, 10", "4, 5, 7"), "", "has 2 nodes");
  says(with("C3D4H", "C3D15"), "", "not read");
  says(with("C3D4H", "C3D" + std::string(30, '8')), "", "no solid elements");
  says(with("0,0,3", "0,zero,3"), "", "\"zero\"");
  says("*NODE\n1,0,0,0\n", "", "no solid elements");
  says(deck, "node,v\n11,1\n", "a.csv:2:1: error: the mesh has no node 11");
  says(deck, "node,v\n1,1\n1,2\n", "comes twice");
  says(deck, "node,v\n1\n", "has 1 values");
  says("1,2,3,4", "node,v\n1,1\n", "belongs to a mesh");
  says("node,v\n1,2\n", "", "columns x, y and z");
}

TEST(Results, TablesOfOtherPrograms) {
  const auto expect_read = [](const std::string& table) {
    std::string said;
    const auto results = read_with(table, "", said);
    ASSERT_TRUE(results) << said << table;
    EXPECT_EQ(results->points, (std::vector<Vec3>{{1, 2, 3.5}, {4, 5, 6}})) << table;
    ASSERT_EQ(results->fields.size(), 2U) << table;
    EXPECT_EQ(results->fields[0].name, "t");
    EXPECT_EQ(results->fields[0].values, (std::vector<double>{20, 30}));
    EXPECT_EQ(results->fields[1].components, 3U) << table;
    EXPECT_EQ(results->fields[1].values, (std::vector<double>{7, 8, 9, 10, 11, 12}));
  };
  const std::string plain = "x,y,z,t,move_x,move_y,move_z\n1,2,3.5,20,7,8,9\n4,5,6,30,10,11,12\n";
  expect_read(plain);
  expect_read("\xEF\xBB\xBF" + plain);
  expect_read("x;y;z;t;move_x;move_y;move_z\n1;2;3,5;20;7;8;9\n4;5;6;30;10;11;12\n");
  expect_read("sep=;\nx;y;z;t;move_x;move_y;move_z\n1;2;3,5;20;7;8;9\n4;5;6;30;10;11;12\n");
  expect_read("x,y,z,t,move_x,move_y,move_z\r1,2,3.5,20,7,8,9\r4,5,6,30,10,11,12\r");
  expect_read("x,y,z,t,move_x,move_y,move_z,\n1,2,3.5,20,7,8,9,\n4,5,6,30,10,11,12,\n");
  expect_read("t,x,y,z,move_x,move_y,move_z\n20,1,2,3.5,7,8,9\n30,4,5,6,10,11,12\n");
  expect_read("x,y,z,kind,t,move_x,move_y,move_z\n1,2,3.5,PLA,20,7,8,9\n4,5,6,,30,10,11,12\n");
  for (const std::string separator : {":", "_"}) {
    const auto three = [&](const std::string& name) {
      return '"' + name + separator + "0\",\"" + name + separator + "1\",\"" + name + separator + "2\"";
    };
    expect_read("\"t\"," + three("move") + "," + three("Points") + "\n20,7,8,9,1,2,3.5\n30,10,11,12,4,5,6\n");
  }
  std::string said;
  EXPECT_FALSE(read_with("x,y,z,t\n1,2,3,20\n4,5,6,warm\n", "", said));
  EXPECT_NE(said.find(":3:1: error: \"warm\" is no number"), std::string::npos) << said;
  EXPECT_FALSE(read_with("x,y,z,t\n1,2,3,20\n4,5,6,\n", "", said));
  EXPECT_NE(said.find(":3:1: error: the column \"t\" has no number here"), std::string::npos) << said;
  EXPECT_FALSE(read_with("\xFF\xFEx,y", "", said));
  EXPECT_NE(said.find("this is text in UTF-16; save it as UTF-8"), std::string::npos) << said;
  EXPECT_FALSE(read_with("x,y,z,t\n1,2,3,warm\n4,5,6,20\n", "", said));
  EXPECT_NE(said.find(":3:1: error: the column \"t\" has words, and here a number"), std::string::npos) << said;
}

TEST(Results, XmlMayBeginWithAByteOrderMark) {
  EXPECT_EQ(read_good("\xEF\xBB\xBF" + vtu_of_tetrahedron("", text_points)).kinds.size(), 1U);
}

TEST(Results, LagrangeCellsOfVtuAreTheKnownOnes) {
  const Results results = read_good(vtu_of_tetrahedron("", text_points, "71"));
  EXPECT_EQ(results.kinds, std::vector<ElementKind>{ElementKind::tetrahedron4});
  EXPECT_NE(error_of(vtu_of_tetrahedron("", text_points, "72")).find("has not the 8 nodes of its type"),
            std::string::npos);
  EXPECT_NE(error_of(vtu_of_tetrahedron("", text_points, "26")).find("is of VTK's type 26"), std::string::npos);
}

TEST(Results, WideFieldsOfVtuAreLeftOut) {
  std::string file = vtu_of_tetrahedron("", text_points);
  const std::string six = "NumberOfComponents=\"6\" format=\"ascii\">10 0 0 0 0 0<";
  file.replace(file.find(six), six.size(), "NumberOfComponents=\"12\" format=\"ascii\">1 2 3 4 5 6 7 8 9 10 11 12<");
  Diagnostics diagnostics;
  const auto results = read_results("a.vtu", file, {}, diagnostics);
  ASSERT_TRUE(results) << to_text(diagnostics);
  EXPECT_EQ(results->fields.size(), 1U);
  EXPECT_NE(to_text(diagnostics).find("fields of more than 9 numbers (stress) are left out"), std::string::npos)
      << to_text(diagnostics);
}

TEST(Results, PointsInTables) {
  std::string said;
  const auto results = read_with("# points\nx,y,z,temperature,vx,vy,vz\n1,2,3,20,1,0,0\n4,5,6,30,0,1,0\n", "", said);
  ASSERT_TRUE(results) << said;
  EXPECT_TRUE(results->kinds.empty());
  EXPECT_EQ(results->points[1], (Vec3{4, 5, 6}));
  ASSERT_EQ(results->fields.size(), 2U);
  EXPECT_EQ(results->fields[1].name, "v");
  EXPECT_EQ(results->fields[1].values, (std::vector<double>{1, 0, 0, 0, 1, 0}));
}

}  // namespace ombre::formats
