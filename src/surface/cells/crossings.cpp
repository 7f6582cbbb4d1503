#include "surface/cells/crossings.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "base/system/steady_pace.h"
#include "base/system/stopwatch.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "surface/cells/border_normals.h"
#include "surface/cells/edge_search.h"
#include "surface/cells/shortened.h"

namespace ombre::surface {
namespace {

constexpr uint32_t leaves_between_checks = 4096;  // number of leaves between two looks at the stop flag
constexpr size_t comparisons_between_checks = 1 << 16;
constexpr int32_t block_units = 16 * units_per_cell;  // side in units of the blocks that share a shortened program

struct EdgeKey {
  CellPlace start{};
  uint8_t axis = 0, level = 0;
  explicit EdgeKey(const CrossedEdge& edge) : start(edge.start), axis(edge.axis), level(edge.level) {}
  bool operator==(const EdgeKey&) const = default;
};
struct EdgeKeyHash {
  size_t operator()(const EdgeKey& key) const { return PlaceHash()(key.start) + size_t{3} * key.level + key.axis; }
};

// Lists the crossings of all edges; copies those already known before growth, and collects the numbers of the others.
class CrossingList {
 public:
  CrossingList(const CellTree& tree, const std::vector<Crossing>& before, const std::vector<uint32_t>& leaves,
               int threads, const StopFlag* stop)
      : tree_(tree), before_(before), leaves_(leaves), stop_(stop) {
    note_before();
    const std::vector<ListedEdge> listed = crossed_edges(tree, !before.empty(), threads, stop);
    all.reserve(same_.size() + listed.size());
    auto next = listed.begin();
    for (uint32_t n = 0; n < tree.leaves().size(); ++n) {
      if (n % leaves_between_checks == 0 && stop && stop->requested()) throw Cancelled();
      take_over(n);
      for (; next != listed.end() && next->leaf == n; ++next) list(next->edge);
    }
  }
  std::vector<Crossing> all;
  std::vector<uint32_t> unknown;

 private:
  // Returns the current number of the leaf that listed the crossing's edge before, if growth has not come near it, so
  // that it still lists the same edges; else none.
  uint32_t same_leaf(const Crossing& crossing) const {
    for (const uint32_t before : crossing.edge.leaves) {
      const uint32_t now = before == CellTree::none ? CellTree::none : leaves_[before];
      if (now == CellTree::none) return CellTree::none;
      const Leaf& leaf = tree_.leaves()[now];
      if (leaf.level == crossing.edge.level) return leaf.is_near_growth ? CellTree::none : now;
    }
    return CellTree::none;
  }

  void note_before() {
    for (uint32_t n = 0; n < before_.size(); ++n) {
      if (n % leaves_between_checks == 0 && stop_ && stop_->requested()) throw Cancelled();
      if (same_leaf(before_[n]) == CellTree::none)
        known_.emplace(EdgeKey(before_[n].edge), n);
      else
        same_.push_back(n);
    }
  }

  void take_over(uint32_t leaf) {
    for (; next_ < same_.size() && same_leaf(before_[same_[next_]]) == leaf; ++next_) {
      Crossing crossing = before_[same_[next_]];
      for (uint32_t& around : crossing.edge.leaves) around = leaves_[around];
      crossing.before = same_[next_];
      all.push_back(crossing);
    }
  }

  void list(const CrossedEdge& edge) {
    const auto found = known_.find(EdgeKey(edge));
    if (found == known_.end()) {
      unknown.push_back(static_cast<uint32_t>(all.size()));
      all.push_back({edge, {}, {}});
    } else {
      all.push_back({edge, before_[found->second].at, before_[found->second].normal, found->second});
    }
  }

  const CellTree& tree_;
  const std::vector<Crossing>& before_;
  const std::vector<uint32_t>& leaves_;
  std::unordered_map<EdgeKey, uint32_t, EdgeKeyHash> known_;
  std::vector<uint32_t> same_;  // numbers before growth of the crossings whose leaf is unchanged
  const StopFlag* stop_;
  size_t next_ = 0;
};

// Sorts crossings by block and returns their numbers, one list per block. All edges of a block have the same length.
std::vector<std::vector<uint32_t>> cut_into_blocks(const std::vector<Crossing>& crossings, std::vector<uint32_t> order,
                                                   const StopFlag* stop) {
  const auto block_of = [&](uint32_t n) {
    const CrossedEdge& edge = crossings[n].edge;
    return std::array<int32_t, 4>{edge.level, edge.start[2] / block_units, edge.start[1] / block_units,
                                  edge.start[0] / block_units};
  };
  size_t comparisons = 0;
  std::ranges::stable_sort(order, [&](uint32_t a, uint32_t b) {
    if (++comparisons % comparisons_between_checks == 0 && stop && stop->requested()) throw Cancelled();
    return block_of(a) < block_of(b);
  });
  std::vector<std::vector<uint32_t>> blocks;
  for (size_t n = 0; n < order.size(); ++n) {
    if (n == 0 || block_of(order[n]) != block_of(order[n - 1])) blocks.emplace_back();
    blocks.back().push_back(order[n]);
  }
  return blocks;
}

EdgeSearch search_of(const CrossedEdge& edge, const CellTree& tree) {
  EdgeSearch search;
  search.start = tree.point(edge.start);
  search.along[edge.axis] = tree.size_mm(edge.level)[edge.axis];
  search.from = edge.from;
  search.to = edge.to;
  return search;
}

// Finds the crossings of a block. If the block's program is long, the block is split, because a smaller box needs a
// shorter program.
class BlockFinder {
 public:
  BlockFinder(const Partition& partition, const CellTree& tree, std::vector<Crossing>& crossings, const StopFlag* stop)
      : partition_(partition), tree_(tree), crossings_(crossings), stop_(stop) {}

  void find(std::vector<uint32_t> block) {
    const program::Program& details = partition_.details.around(box_of(block).expanded(margin_of(block)));
    find(details, std::move(block), block_units);
  }

 private:
  // Greatest product of crossings and operations that is not split. Shortening a program costs about as much as ten
  // points.
  static constexpr size_t most_work = 20000;

  Vec3 cell_of(const std::vector<uint32_t>& block) const { return tree_.size_mm(crossings_[block[0]].edge.level); }

  double margin_of(const std::vector<uint32_t>& block) const {
    const Vec3 cell_mm = cell_of(block);
    return normals_reach * std::max({cell_mm.x, cell_mm.y, cell_mm.z});
  }

  void find(const program::Program& details, std::vector<uint32_t> block, int32_t units_a_side) {
    if (stop_ && stop_->requested()) throw Cancelled();
    const program::Program program = shortened_for(details, box_of(block).expanded(margin_of(block)));
    if (units_a_side > 1 && block.size() * program.code.size() > most_work)
      return cut(program, block, units_a_side / 2);
    std::vector<EdgeSearch> searches;
    for (const uint32_t n : block) searches.push_back(search_of(crossings_[n].edge, tree_));
    PointEvaluator evaluator;
    evaluator.begin(partition_, program);
    search_edges(searches, evaluator);
    const std::vector<Vec3> normals = border_normals(searches, cell_of(block), evaluator);
    for (size_t m = 0; m < block.size(); ++m) {
      crossings_[block[m]].at = searches[m].point(searches[m].t);
      crossings_[block[m]].normal = normals[m];
    }
  }

  Box box_of(const std::vector<uint32_t>& block) const {
    Box box;
    for (const uint32_t n : block) {
      const EdgeSearch edge = search_of(crossings_[n].edge, tree_);
      box = hull(box, {edge.point(0), edge.point(1)});
    }
    return box;
  }

  void cut(const program::Program& program, const std::vector<uint32_t>& block, int32_t units_a_side) {
    std::array<std::vector<uint32_t>, 8> parts;
    for (const uint32_t n : block) {
      const CellPlace& at = crossings_[n].edge.start;
      size_t part = 0;
      for (size_t axis = 0; axis < 3; ++axis) part |= static_cast<size_t>(at[axis] / units_a_side % 2) << axis;
      parts[part].push_back(n);
    }
    for (std::vector<uint32_t>& part : parts)
      if (!part.empty()) find(program, std::move(part), units_a_side);
  }

  const Partition& partition_;
  const CellTree& tree_;
  std::vector<Crossing>& crossings_;
  const StopFlag* stop_;
};

std::vector<Crossing> find(const Partition& partition, const CellTree& tree, CrossingList crossings, int threads,
                           Progress* progress, const StopFlag* stop) {
  const auto blocks = cut_into_blocks(crossings.all, std::move(crossings.unknown), stop);
  const Stopwatch watch;
  std::atomic<uint64_t> done = 0;
  run_parallel(blocks.size(), threads, [&](size_t n) {
    BlockFinder(partition, tree, crossings.all, stop).find(blocks[n]);
    const uint64_t now = ++done;
    if (progress) progress->update(at_steady_pace(now, blocks.size(), watch.seconds()));
  });
  return std::move(crossings.all);
}

}  // namespace

std::vector<Crossing> find_crossings(const Partition& partition, const CellTree& tree, int threads, Progress* progress,
                                     const StopFlag* stop) {
  return find(partition, tree, CrossingList(tree, {}, {}, threads, stop), threads, progress, stop);
}

std::vector<Crossing> crossings_at(const std::vector<BorderPoint>& points, const CellTree& tree, int threads,
                                   const StopFlag* stop) {
  std::vector<Crossing> crossings = CrossingList(tree, {}, {}, threads, stop).all;
  if (crossings.size() != points.size())
    throw Error(Code::other_job, "the cells have " + format_count(crossings.size()) + " crossed edges, and " +
                                     format_count(points.size()) + " crossings were found before");
  for (size_t n = 0; n < points.size(); ++n) {
    crossings[n].at = points[n].at;
    crossings[n].normal = points[n].normal;
  }
  return crossings;
}

std::vector<Crossing> find_crossings_after_growth(const Partition& partition, const CellTree& tree,
                                                  const std::vector<Crossing>& before,
                                                  const std::vector<uint32_t>& leaves, int threads,
                                                  const StopFlag* stop) {
  return find(partition, tree, CrossingList(tree, before, leaves, threads, stop), threads, nullptr, stop);
}

}  // namespace ombre::surface
