#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "fea/files/inp_writer.h"
#include "fea/files/vtu_writer.h"
#include "fea/model/test_models.h"

namespace ombre::fea {
namespace {

using namespace test;

Model two_sections() {
  Model model = model_of(block({2, 1, 1}, {1, 1, 1}), {2850, 0.39, 1.18e-9});
  model.sections[0].name = "vero white";
  model.sections.push_back({"50/50 mix", {10, 0.45, 0}});
  model.section_of[1] = 1;
  return model;
}

// The expected lines of the deck were written by hand.
TEST(InpWriter, DecksAreComplete) {
  std::string deck;
  const Conditions conditions{{{0, 2, 0}, {5, 0, -0.25}}, {{11, 1, 3.5}}};
  write_inp(two_sections(), conditions, BrickType::c3d8i, "part.vcad", [&](std::string_view text) { deck += text; });
  EXPECT_EQ(deck, R"(*HEADING
part.vcad; mm, N, MPa, tonne
*NODE, NSET=NALL
1, 0, 0, 0
2, 1, 0, 0
3, 2, 0, 0
4, 0, 1, 0
5, 1, 1, 0
6, 2, 1, 0
7, 0, 0, 1
8, 1, 0, 1
9, 2, 0, 1
10, 0, 1, 1
11, 1, 1, 1
12, 2, 1, 1
*ELEMENT, TYPE=C3D8I, ELSET=VERO_WHITE
1, 1, 2, 5, 4, 7, 8, 11, 10
*ELEMENT, TYPE=C3D8I, ELSET=M_50_50_MIX
2, 2, 3, 6, 5, 8, 9, 12, 11
*MATERIAL, NAME=VERO_WHITE
*ELASTIC
2850, 0.39
*DENSITY
1.18e-09
*SOLID SECTION, ELSET=VERO_WHITE, MATERIAL=VERO_WHITE
*MATERIAL, NAME=M_50_50_MIX
*ELASTIC
10, 0.45
*SOLID SECTION, ELSET=M_50_50_MIX, MATERIAL=M_50_50_MIX
*STEP
*STATIC
*BOUNDARY
1, 3, 3, 0
6, 1, 1, -0.25
*CLOAD
12, 2, 3.5
*NODE FILE
U, RF
*EL FILE
S, E
*END STEP
)");
}

// The deck has conduction with a film, a named set, and a number that is longer than CalculiX reads.
TEST(InpWriter, ConductionIsInMilliwatts) {
  MeshModel model{
      {ElementKind::c3d4, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 1, 2, 3}}, {{"wall", {}, 0.25}}, {0}, {}};
  Conditions conditions{{{0, 0, 20}}, {{3, 0, 1.0 / 3e6}}, {{"hot side", {0, 2}}}, Physics::heat, {{{0, 2}, 25, 18}}};
  std::string deck;
  write_inp(model, conditions, BrickType::c3d8r, "t", [&](std::string_view text) { deck += text; });
  EXPECT_EQ(deck.substr(deck.find("*ELEMENT")), R"(*ELEMENT, TYPE=C3D4, ELSET=WALL
1, 1, 2, 3, 4
*NSET, NSET=HOT_SIDE
1, 3
*MATERIAL, NAME=WALL
*CONDUCTIVITY
0.25
*SOLID SECTION, ELSET=WALL, MATERIAL=WALL
*STEP
*HEAT TRANSFER, STEADY STATE
*BOUNDARY
1, 11, 11, 20
*CFLUX
4, 11, 0.000333333333333
*FILM
1, F3, 18, 0.025
*NODE FILE
NT, RFL
*EL FILE
HFL
*END STEP
)");
}

// Returns the numbers of an array, which its offset locates.
template <class T>
std::vector<T> array(const std::string& file, const std::string& name) {
  const size_t tag = file.find("Name=\"" + name + "\"");
  EXPECT_NE(tag, std::string::npos) << name;
  const size_t offset = std::stoul(file.substr(file.find("offset=\"", tag) + 8));
  const size_t begin = file.find("<AppendedData encoding=\"raw\">\n_") + 31 + offset;
  uint64_t bytes = 0;
  std::memcpy(&bytes, file.data() + begin, sizeof bytes);
  std::vector<T> values(bytes / sizeof(T));
  std::memcpy(values.data(), file.data() + begin + sizeof bytes, bytes);
  return values;
}

TEST(VtuWriter, ArraysStandWhereTheirOffsetsSay) {
  const Model model = two_sections();
  const std::vector<ValueField> of_bricks{{"a<b", "MPa", 1, {1, 2}}, {"stress", "MPa", 6, std::vector<float>(12, 3)}};
  std::vector<float> moves(36);
  for (size_t n = 0; n < moves.size(); ++n) moves[n] = static_cast<float>(n);
  std::string file;
  write_vtu(model.bricks, of_bricks, {{"displacement", "mm", 3, moves}}, [&](std::string_view text) { file += text; });
  EXPECT_EQ(array<float>(file, "a&lt;b [MPa]"), (std::vector<float>{1, 2}));
  EXPECT_EQ(array<float>(file, "displacement [mm]"), moves);
  EXPECT_EQ(array<int64_t>(file, "offsets"), (std::vector<int64_t>{8, 16}));
  EXPECT_EQ(array<uint8_t>(file, "types"), (std::vector<uint8_t>{12, 12}));
  const auto points = array<double>(file, "points");
  const auto corners = array<int64_t>(file, "connectivity");
  ASSERT_EQ(points.size(), 36U);
  for (size_t n = 0; n < corners.size(); ++n)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(points[3 * static_cast<size_t>(corners[n]) + static_cast<size_t>(axis)],
                model.bricks.node(model.bricks.nodes[n / 8][n % 8])[axis]);
  EXPECT_TRUE(file.ends_with("</AppendedData>\n</VTKFile>\n"));
}

}  // namespace
}  // namespace ombre::fea
