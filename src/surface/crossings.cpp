#include "surface/crossings.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "base/error.h"
#include "base/steady_pace.h"
#include "base/stopwatch.h"
#include "base/tasks.h"
#include "surface/border_normals.h"
#include "surface/edge_search.h"

namespace ombre::surface {
namespace {

constexpr int32_t block_cells = 16;  // along each axis of a block that shares a shortened program

std::vector<Crossing> list_crossings(const MixedCells& cells) {
  std::vector<Crossing> crossings;
  for (uint32_t n = 0; n < cells.cells().size(); ++n)
    for (int axis = 0; axis < 3; ++axis) {
      const MixedCell& cell = cells.cells()[n];
      const int edge = edge_number(axis, 0, 0);
      if (cell.crosses(edge))
        crossings.push_back(
            {n, static_cast<uint8_t>(axis), cell.corners[0], cell.corners[second_corner(edge)], {}, {}});
    }
  return crossings;
}

// Numbers of crossings, block by block.
std::vector<std::vector<uint32_t>> cut_into_blocks(const MixedCells& cells, const std::vector<Crossing>& crossings) {
  const auto block_of = [&](uint32_t n) {
    const CellPlace& at = cells.cells()[crossings[n].cell].at;
    return std::array<int32_t, 3>{at[2] / block_cells, at[1] / block_cells, at[0] / block_cells};
  };
  std::vector<uint32_t> order(crossings.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return block_of(a) < block_of(b); });
  std::vector<std::vector<uint32_t>> blocks;
  for (size_t n = 0; n < order.size(); ++n) {
    if (n == 0 || block_of(order[n]) != block_of(order[n - 1])) blocks.emplace_back();
    blocks.back().push_back(order[n]);
  }
  return blocks;
}

Vec3 cell_size(const voxel::Lattice& lattice) {
  return {lattice.pitch[0].mm(), lattice.pitch[1].mm(), lattice.pitch[2].mm()};
}

EdgeSearch edge_of(const Crossing& crossing, const MixedCells& cells) {
  const voxel::Lattice& lattice = cells.lattice();
  const CellPlace& at = cells.cells()[crossing.cell].at;
  EdgeSearch search;
  search.start = lattice.center(at[0], at[1], at[2]);
  search.along[crossing.axis] = lattice.pitch[crossing.axis].mm();
  search.from = crossing.from;
  search.to = crossing.to;
  return search;
}

// Finds the crossings of a block, in parts where its program is long: in a smaller box less of it matters.
class BlockFinder {
 public:
  BlockFinder(const Partition& partition, const MixedCells& cells, std::vector<Crossing>& crossings,
              const StopFlag* stop)
      : partition_(partition), cells_(cells), crossings_(crossings), stop_(stop) {
    const Vec3 cell_mm = cell_size(cells.lattice());
    margin_ = normals_reach * std::max({cell_mm.x, cell_mm.y, cell_mm.z});
  }

  void find(const program::Program& details, std::vector<uint32_t> block, int32_t cells_a_side) {
    if (stop_ && stop_->requested()) throw Cancelled();
    const program::Program program = shortened_for(details, box_of(block).expanded(margin_));
    if (cells_a_side > 1 && block.size() * program.code.size() > most_work)
      return cut(program, block, cells_a_side / 2);
    std::vector<EdgeSearch> searches;
    for (const uint32_t n : block) searches.push_back(edge_of(crossings_[n], cells_));
    PointAsker asker;
    asker.begin(partition_, program);
    search_edges(searches, asker);
    const std::vector<Vec3> normals = border_normals(searches, cell_size(cells_.lattice()), asker);
    for (size_t m = 0; m < block.size(); ++m) {
      crossings_[block[m]].at = searches[m].point(searches[m].t);
      crossings_[block[m]].normal = normals[m];
    }
  }

 private:
  // Crossings times operations; asking intervals of a part costs some ten points.
  static constexpr size_t most_work = 20000;

  Box box_of(const std::vector<uint32_t>& block) const {
    Box box;
    for (const uint32_t n : block) {
      const EdgeSearch edge = edge_of(crossings_[n], cells_);
      box = hull(box, {edge.point(0), edge.point(1)});
    }
    return box;
  }

  void cut(const program::Program& program, const std::vector<uint32_t>& block, int32_t cells_a_side) {
    std::array<std::vector<uint32_t>, 8> parts;
    for (const uint32_t n : block) {
      const CellPlace& at = cells_.cells()[crossings_[n].cell].at;
      size_t part = 0;
      for (size_t axis = 0; axis < 3; ++axis) part |= static_cast<size_t>(at[axis] / cells_a_side % 2) << axis;
      parts[part].push_back(n);
    }
    for (std::vector<uint32_t>& part : parts)
      if (!part.empty()) find(program, std::move(part), cells_a_side);
  }

  const Partition& partition_;
  const MixedCells& cells_;
  std::vector<Crossing>& crossings_;
  const StopFlag* stop_;
  double margin_ = 0;
};

}  // namespace

std::vector<Crossing> find_crossings(const Partition& partition, const MixedCells& cells, int threads,
                                     Progress* progress, const StopFlag* stop) {
  std::vector<Crossing> crossings = list_crossings(cells);
  const auto blocks = cut_into_blocks(cells, crossings);
  const Stopwatch watch;
  std::atomic<uint64_t> done = 0;
  run_parallel(blocks.size(), threads, [&](size_t n) {
    BlockFinder(partition, cells, crossings, stop).find(partition.details, blocks[n], block_cells);
    const uint64_t now = ++done;
    if (progress) progress->update(at_steady_pace(now, blocks.size(), watch.seconds()));
  });
  return crossings;
}

}  // namespace ombre::surface
