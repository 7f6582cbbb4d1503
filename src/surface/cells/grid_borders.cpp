#include "surface/cells/grid_borders.h"

#include <iterator>

namespace ombre::surface {
namespace {

template <class T>
void move_to_end(std::vector<T>&& from, std::vector<T>& to) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

void GridBorders::append(GridBorders&& above) {
  move_to_end(std::move(above.cells), cells);
  move_to_end(std::move(above.crossings), crossings);
  move_to_end(std::move(above.hidden), hidden);
}

GridBorders find_grid_borders(CellLayers layers, const Partition& partition, const voxel::Lattice& corners,
                              bool with_hidden, const Workers& workers, Progress* progress) {
  GridBorders found;
  found.cells = mixed_cells_in(layers, partition.label, corners, workers.threads, progress, workers.stop);
  const CellTree tree(MixedCells(corners, found.cells));
  for (const Crossing& crossing : find_crossings(partition, tree, workers.threads, progress, workers.stop))
    found.crossings.push_back({crossing.at, crossing.normal});
  if (!with_hidden) return found;
  hidden_edges_in(layers, partition.label, tree, workers.threads, workers.stop,
                  [&](const std::vector<CrossedEdge>& edges) {
                    found.hidden.push_back(edges);
                    return true;
                  });
  return found;
}

}  // namespace ombre::surface
