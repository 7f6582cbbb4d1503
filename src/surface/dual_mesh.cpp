#include "surface/dual_mesh.h"

#include "base/assert.h"
#include "surface/cell_parts.h"

namespace ombre::surface {
namespace {

// The cells around an edge: one step back along the axes on which the edge has an offset in them.
CellPlace cell_around(const CellPlace& at, int axis, const std::array<int, 2>& offsets) {
  CellPlace place = at;
  place[static_cast<size_t>((axis + 1) % 3)] -= offsets[0];
  place[static_cast<size_t>((axis + 2) % 3)] -= offsets[1];
  return place;
}

// What two regions meet on an edge; a cell's part may see several such pairs.
class PairsOfParts {
 public:
  void note(Label a, Label b) {
    const std::array<Label, 2> pair{std::min(a, b), std::max(a, b)};
    if (!is_empty_ && pair != pair_) has_many_ = true;
    pair_ = pair;
    is_empty_ = false;
  }
  bool is_one() const { return !has_many_; }

 private:
  std::array<Label, 2> pair_{};
  bool is_empty_ = true, has_many_ = false;
};

}  // namespace

DualMesh make_dual_mesh(const MixedCells& cells, const std::vector<Crossing>& crossings) {
  DualMesh mesh;
  std::vector<CellParts> parts_of;
  std::vector<uint32_t> first_vertex;
  for (uint32_t n = 0; n < cells.cells().size(); ++n) {
    const MixedCell& cell = cells.cells()[n];
    const CellParts parts = find_cell_parts(cell.corners);
    std::array<PairsOfParts, 12> pairs;
    for (int e = 0; e < 12; ++e)
      if (cell.crosses(e))
        pairs[parts.part_of_edge[static_cast<size_t>(e)]].note(cell.corners[first_corner(e)],
                                                               cell.corners[second_corner(e)]);
    parts_of.push_back(parts);
    first_vertex.push_back(static_cast<uint32_t>(mesh.vertices.size()));
    for (size_t part = 0; part < parts.count; ++part) mesh.vertices.push_back({n, pairs[part].is_one(), {}});
  }
  mesh.quads.reserve(crossings.size());
  for (uint32_t n = 0; n < crossings.size(); ++n) {
    const Crossing& crossing = crossings[n];
    DualQuad quad{n, {}};
    for (size_t corner = 0; corner < 4; ++corner) {
      const auto& offsets = quad_offsets[corner];
      const uint32_t cell = cells.find(cell_around(cells.cells()[crossing.cell].at, crossing.axis, offsets));
      ASSERT(cell != MixedCells::none);
      const int edge = edge_number(crossing.axis, offsets[0], offsets[1]);
      quad.corners[corner] = first_vertex[cell] + parts_of[cell].part_of_edge[static_cast<size_t>(edge)];
      mesh.vertices[quad.corners[corner]].planes.add(crossing.at, crossing.normal);
    }
    mesh.quads.push_back(quad);
  }
  return mesh;
}

}  // namespace ombre::surface
