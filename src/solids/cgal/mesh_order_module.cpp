#include <algorithm>
#include <numeric>

#include "solids/mesh_module.h"

namespace ombre::solids {
namespace {

// Sorts nodes in ascending order, except the last two if that would invert the tetrahedron.
void sort_evenly(std::array<uint32_t, 4>& nodes) {
  bool is_odd = false;
  for (size_t a = 0; a < 4; ++a)
    for (size_t b = a + 1; b < 4; ++b) is_odd ^= nodes[a] > nodes[b];
  std::sort(nodes.begin(), nodes.end());
  if (is_odd) std::swap(nodes[2], nodes[3]);
}

std::vector<uint32_t> sorted_points(const std::vector<Vec3>& points) {
  std::vector<uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](uint32_t n) { return std::array{points[n].z, points[n].y, points[n].x}; };
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
  return order;
}

}  // namespace

void put_in_order(Tetrahedra& made) {
  const std::vector<uint32_t> order = sorted_points(made.points);
  std::vector<uint32_t> place(order.size());
  std::vector<Vec3> points;
  for (uint32_t n = 0; n < order.size(); ++n) {
    place[order[n]] = n;
    points.push_back(made.points[order[n]]);
  }
  made.points = std::move(points);
  struct Cell {
    std::array<uint32_t, 4> nodes;
    uint32_t region;
  };
  std::vector<Cell> cells;
  for (size_t n = 0; n < made.nodes.size(); ++n) {
    Cell cell{made.nodes[n], made.regions[n]};
    for (uint32_t& node : cell.nodes) node = place[node];
    sort_evenly(cell.nodes);
    cells.push_back(cell);
  }
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.nodes < b.nodes; });
  for (size_t n = 0; n < cells.size(); ++n) {
    made.nodes[n] = cells[n].nodes;
    made.regions[n] = cells[n].region;
  }
}

}  // namespace ombre::solids
