#include "surface/outline/outline.h"

#include <algorithm>
#include <tuple>

#include "base/system/assert.h"
#include "base/text/error.h"
#include "surface/outline/outline_crossings.h"
#include "surface/outline/outline_simplify.h"
#include "voxel/layers.h"

namespace ombre::surface {
namespace {

// The rest of the tolerance covers the error of a straight line between two crossings of a cell.
constexpr double simplifying_share = 0.5;  // share of the tolerance

void take(const voxel::FieldTile& tile, CornerLabels& corners) {
  const float* from = tile.values.data();
  for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j)
    for (int64_t i = tile.box.lo[0]; i < tile.box.hi[0]; ++i) {
      corners.labels[static_cast<size_t>(j * corners.width + i)] = static_cast<Label>(*from);
      if (!tile.is_uniform) ++from;
    }
}

void clear_outermost(CornerLabels& corners) {
  const auto width = static_cast<size_t>(corners.width), height = static_cast<size_t>(corners.height);
  for (size_t j = 0; j < height; ++j) {
    Label* row = corners.labels.data() + j * width;
    if (j == 0 || j + 1 == height) std::fill_n(row, width, Label{0});
    row[0] = row[width - 1] = 0;
  }
}

// A chain, oriented so that a region is on its left.
struct Side {
  Label region = 0;
  uint32_t start = 0, chain = 0;
  bool is_reversed = false;
  auto key() const { return std::tuple(region, start); }
};

// Joins chains to polygons. At a junction each region begins one chain and ends another, so following the chains leads
// around the region.
class Assembler {
 public:
  Assembler(const OutlineGraph& graph, const std::vector<OutlineChain>& chains) : graph_(graph), chains_(chains) {
    for (uint32_t c = 0; c < chains.size(); ++c) {
      sides_.push_back({chains[c].left, chains[c].nodes.front(), c, false});
      sides_.push_back({chains[c].right, chains[c].nodes.back(), c, true});
    }
    std::ranges::sort(sides_, {}, [](const Side& s) { return std::tuple(s.key(), s.chain, s.is_reversed); });
    is_used_.resize(sides_.size());
  }

  LayerOutline assemble(size_t regions) {
    LayerOutline made{std::vector<std::vector<Polygon>>(regions)};
    for (size_t n = 0; n < sides_.size(); ++n) {
      if (is_used_[n] || sides_[n].region == 0) continue;
      Polygon polygon = trace(n);
      if (polygon.size() >= 3) made.regions[sides_[n].region - 1U].push_back(std::move(polygon));
    }
    for (auto& polygons : made.regions)
      std::stable_partition(polygons.begin(), polygons.end(), [](const Polygon& p) { return area_mm2(p) > 0; });
    return made;
  }

 private:
  Polygon trace(size_t n) {
    Polygon polygon;
    while (!is_used_[n]) {
      is_used_[n] = true;
      const uint32_t end = append(sides_[n], polygon);
      if (end == sides_[n].start) break;
      n = after({sides_[n].region, end});
    }
    while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
    return polygon;
  }

  // Appends all points but the last. Returns the last node.
  uint32_t append(const Side& side, Polygon& polygon) const {
    const auto& nodes = chains_[side.chain].nodes;
    for (size_t n = 0; n + 1 < nodes.size(); ++n) {
      const Vec2 p = point_of(graph_, nodes[side.is_reversed ? nodes.size() - 1 - n : n]);
      if (polygon.empty() || !(polygon.back() == p)) polygon.push_back(p);
    }
    return side.is_reversed ? nodes.front() : nodes.back();
  }

  size_t after(const Side& wanted) const {
    const auto found = std::ranges::lower_bound(sides_, wanted.key(), {}, &Side::key);
    ASSERT(found != sides_.end() && found->key() == wanted.key());
    return static_cast<size_t>(found - sides_.begin());
  }

  const OutlineGraph& graph_;
  const std::vector<OutlineChain>& chains_;
  std::vector<Side> sides_;
  std::vector<bool> is_used_;
};

}  // namespace

double area_mm2(const Polygon& polygon) {
  double twice = 0;
  for (size_t n = 0; n < polygon.size(); ++n)
    twice += cross(polygon[n] - polygon[0], polygon[(n + 1) % polygon.size()] - polygon[0]);
  return 0.5 * twice;
}

double area_mm2(const std::vector<Polygon>& polygons) {
  double area = 0;
  for (const Polygon& polygon : polygons) area += area_mm2(polygon);
  return area;
}

Outliner::Outliner(const Partition& partition, const voxel::Lattice& corners, double tolerance_mm)
    : partition_(partition),
      corners_(corners),
      evaluator_(partition.label, corners, voxel::best_evaluator(corners)),
      tolerance_mm_(tolerance_mm) {}

LayerOutline Outliner::layer(int64_t k, const StopFlag* stop) const {
  CornerLabels corners{static_cast<int32_t>(corners_.count[0]), static_cast<int32_t>(corners_.count[1]), {}};
  corners.labels.resize(static_cast<size_t>(corners_.count[0] * corners_.count[1]));
  const voxel::TileBox box{{0, 0, k}, {corners_.count[0], corners_.count[1], k + 1}};
  for (const voxel::FieldTile& tile : evaluator_.tiles(box, stop)) take(tile, corners);
  clear_outermost(corners);
  OutlineGraph graph = trace_cells(corners);
  find_outline_crossings(partition_, corners_, k, graph, stop);
  place_outline_vertices(corners_, graph);
  const std::vector<OutlineChain> chains = untangle(corners_, graph);
  return Assembler(graph, simplify(graph, chains, simplifying_share * tolerance_mm_)).assemble(partition_.regions);
}

}  // namespace ombre::surface
