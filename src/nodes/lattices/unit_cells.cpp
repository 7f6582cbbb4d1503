#include "nodes/lattices/unit_cells.h"

#include <algorithm>
#include <array>

namespace ombre::nodes {
namespace {

using Struts = std::vector<std::pair<Vec3, Vec3>>;

void add(Struts& struts, Vec3 a, Vec3 b) {
  const auto is_known = [&](const auto& strut) { return strut == std::pair(a, b) || strut == std::pair(b, a); };
  if (std::none_of(struts.begin(), struts.end(), is_known)) struts.emplace_back(a, b);
}

// Returns all images under the symmetries of a cube: permutations and reflections of the axes.
Struts symmetric(const Struts& some) {
  Struts all;
  for (const auto& [a, b] : some) {
    std::array<int, 3> order{0, 1, 2};
    do {
      for (int signs = 0; signs < 8; ++signs) {
        const Vec3 s{signs & 1 ? -1.0 : 1.0, signs & 2 ? -1.0 : 1.0, signs & 4 ? -1.0 : 1.0};
        const auto image = [&](Vec3 p) {
          return Vec3{0 + s.x * p[order[0]], 0 + s.y * p[order[1]], 0 + s.z * p[order[2]]};  // adding 0 turns -0 into 0
        };
        add(all, image(a), image(b));
      }
    } while (std::next_permutation(order.begin(), order.end()));
  }
  return all;
}

Struts joined(std::initializer_list<Struts> lists) {
  Struts all;
  for (const Struts& list : lists)
    for (const auto& [a, b] : list) add(all, a, b);
  return all;
}

const Vec3 centre{0, 0, 0}, face{0.5, 0, 0}, edge{0.5, 0.5, 0}, vertex{0.5, 0.5, 0.5};

Struts edges_along_z() {
  Struts struts;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5}) add(struts, {x, y, 0}, {x, y, z});
  return struts;
}

// Four atoms in alternate eighths of the cell, each bound to the four nearest points of a face-centred lattice.
Struts diamond() {
  Struts struts;
  const Vec3 signs[] = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  for (const Vec3 atom : signs)
    for (const Vec3 bond : signs) add(struts, 0.25 * atom, 0.25 * (atom + bond));
  return struts;
}

std::vector<UnitCell> all_cells() {
  const Struts cubic = symmetric({{edge, vertex}}), bcc = symmetric({{centre, vertex}}),
               fcc = symmetric({{face, vertex}}), octahedral = symmetric({{face, {0, 0.5, 0}}});
  return {
      {"cubic", "the edges of the cell", cubic},
      {"bcc", "body-centred cubic: from the centre to the corners", bcc},
      {"bccz", "bcc with the edges along z", joined({bcc, edges_along_z()})},
      {"fcc", "face-centred cubic: the diagonals of the faces", fcc},
      {"fccz", "fcc with the edges along z", joined({fcc, edges_along_z()})},
      {"f2bcc", "fcc and bcc together", joined({fcc, bcc})},
      {"octahedral", "between the centres of neighbouring faces", octahedral},
      {"octet", "octet truss: fcc and octahedral together", joined({fcc, octahedral})},
      {"kelvin", "the edges of a truncated octahedron, which fills space",
       symmetric({{{0.5, 0.25, 0}, {0.5, 0, 0.25}}, {{0.5, 0.25, 0}, {0.25, 0.5, 0}}})},
      {"rhombic_dodecahedron", "the edges of rhombic dodecahedra, which fill space",
       symmetric({{face, 0.5 * vertex}, {vertex, 0.5 * vertex}})},
      {"diamond", "bonds of a diamond crystal", diamond(), false},
  };
}

}  // namespace

const std::vector<UnitCell>& unit_cells() {
  static const std::vector<UnitCell> cells = all_cells();
  return cells;
}

const UnitCell* find_unit_cell(std::string_view name) {
  const auto& cells = unit_cells();
  const auto it = std::find_if(cells.begin(), cells.end(), [&](const UnitCell& cell) { return cell.name == name; });
  return it == cells.end() ? nullptr : &*it;
}

std::vector<std::string> unit_cell_names() {
  std::vector<std::string> names;
  for (const UnitCell& cell : unit_cells()) names.emplace_back(cell.name);
  return names;
}

}  // namespace ombre::nodes
