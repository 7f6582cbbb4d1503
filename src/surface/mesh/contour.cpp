#include "surface/mesh/contour.h"

#include <algorithm>

#include "base/text/error.h"
#include "base/text/text.h"
#include "surface/mesh/lost_parts.h"
#include "surface/mesh/refinement.h"
#include "surface/mesh/surface_maker.h"

namespace ombre::surface {
namespace {

constexpr int most_cutting_rounds = 16, most_finishing_rounds = 3;
// Number of leaves that subdivision may add; twice the number of the grid's mixed cells if that is more.
constexpr size_t most_more_leaves = size_t{1} << 22;
constexpr size_t leaves_of_hidden_edge = 8;  // approximate number of leaves that it takes to resolve a hidden edge
// Trees with at least this many leaves get one round of finishing if triangles still intersect: more rounds would not
// remove the intersections.
constexpr size_t most_leaves_of_rounds = size_t{1} << 21;

// Returns the greatest number of leaves. Throws Error if the grid's cells alone need more memory than is allowed.
size_t most_leaves(size_t grid_leaves, size_t memory_bytes) {
  const size_t wanted = grid_leaves + std::max(most_more_leaves, 2 * grid_leaves);
  if (memory_bytes == 0) return wanted;
  const double allowed = static_cast<double>(memory_bytes) / bytes_per_mixed_cell;
  if (static_cast<double>(grid_leaves) > allowed)
    throw Error(Code::memory, format_count(grid_leaves) + " cells at the surface take about " +
                                  format_bytes(static_cast<double>(grid_leaves) * bytes_per_mixed_cell) +
                                  " of memory, more than the " + format_bytes(static_cast<double>(memory_bytes)) +
                                  " allowed; choose a larger " + spelled::option("--cell") + " or " +
                                  spelled::option("--tolerance") + ", or more " + spelled::option("--memory"));
  return std::min(wanted, static_cast<size_t>(allowed));
}

class CellRefiner {
 public:
  CellRefiner(const Partition& partition, const ContourOptions& options, Progress* progress, const GridBorders* known)
      : partition_(partition),
        options_(options),
        progress_(progress),
        known_(known),
        tree_(grid_cells()),
        most_leaves_(most_leaves(tree_.leaves().size(), options.memory_bytes)),
        crossings_(grid_crossings()),
        mesh_(make_dual_mesh(tree_, crossings_, options.workers)),
        check_(partition, options),
        intersections_(options.workers) {}

  RegionSurface make() {
    for (int round = 0, finished = 0;; ++round) {
      if (progress_) progress_->update({static_cast<uint64_t>(round), most_cutting_rounds + most_finishing_rounds});
      SurfaceMaker maker(tree_, crossings_, mesh_, options_, check_, intersections_);
      maker.bring_near();
      if (round < most_cutting_rounds) {
        const Growth coarse = maker.coarse_cells();
        if (cut(coarse, round == 0 ? hidden_edges(maker) : std::vector<CrossedEdge>())) continue;
      }
      maker.finish(partition_);
      // Mending may have moved the surface too far off.
      if (++finished < rounds_of_finishing(maker) && cut(maker.far_cells(), {})) continue;
      maker.undo_far_moves();
      return maker.build();
    }
  }

 private:
  MixedCells grid_cells() const {
    if (known_) return {options_.corners, known_->cells};
    return find_mixed_cells(partition_.label, options_.corners, options_.workers.threads, progress_,
                            options_.workers.stop);
  }

  std::vector<Crossing> grid_crossings() const {
    if (known_) return crossings_at(known_->crossings, tree_, options_.workers.threads, options_.workers.stop);
    return find_crossings(partition_, tree_, options_.workers.threads, progress_, options_.workers.stop);
  }

  void each_hidden_edge(const TakeEdges& take) const {
    if (!known_)
      return find_hidden_edges(partition_.label, tree_, options_.workers.threads, options_.workers.stop, take);
    EdgeBatches batches(take);
    for (const std::vector<CrossedEdge>& strip : known_->hidden)
      if (!batches.add(strip)) break;
    batches.finish();
  }

  int rounds_of_finishing(const SurfaceMaker& maker) const {
    const bool may_settle = maker.crosses_nowhere() || tree_.leaves().size() < most_leaves_of_rounds;
    return may_settle ? most_finishing_rounds : 1;
  }

  std::vector<CrossedEdge> hidden_edges(SurfaceMaker& maker) const {
    if (options_.tolerance_mm == 0) return {};
    return maker.far_hidden_edges([&](const TakeEdges& take) { each_hidden_edge(take); },
                                  (most_leaves_ - tree_.leaves().size()) / leaves_of_hidden_edge);
  }

  // Subdivides cells. Returns false if there is nothing to subdivide or the tree has reached its greatest size.
  bool cut(const Growth& cells, const std::vector<CrossedEdge>& hidden) {
    if (cells.is_empty() && hidden.empty()) return false;
    if (tree_.leaves().size() >= most_leaves_) return false;
    const std::vector<Leaf> before = tree_.leaves();
    refine(tree_, cells, hidden, most_leaves_, partition_, options_.workers.threads, options_.workers.stop);
    const std::vector<uint32_t> numbers = numbers_after_growth(before, tree_.leaves());
    crossings_ = find_crossings_after_growth(partition_, tree_, crossings_, numbers, options_.workers.threads,
                                             options_.workers.stop);
    mesh_ = make_dual_mesh_after_growth(tree_, crossings_, mesh_, numbers, options_.workers);
    check_.renumber(crossings_);
    intersections_.renumber(crossings_);
    return true;
  }

  const Partition& partition_;
  const ContourOptions& options_;
  Progress* progress_;
  const GridBorders* known_;
  CellTree tree_;
  size_t most_leaves_;
  std::vector<Crossing> crossings_;
  DualMesh mesh_;
  FacetCheck check_;
  IntersectionFinder intersections_;
};

}  // namespace

RegionSurface contour(const Partition& partition, const ContourOptions& options, Progress* progress,
                      const GridBorders* known) {
  RegionSurface surface = CellRefiner(partition, options, progress, known).make();
  surface.report.lost =
      find_lost_parts(partition, surface, options.corners, options.workers.threads, options.workers.stop);
  return surface;
}

}  // namespace ombre::surface
