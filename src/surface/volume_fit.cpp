#include "surface/volume_fit.h"

#include "surface/label_asker.h"

namespace ombre::surface {
namespace {

constexpr double least_cosine = 0.5;  // between normals around a vertex of a smooth border
// How far vertices move outwards: by so much of how far they lie from the middle of the crossings, as far as that comes
// from a cluster's extent, and inwards by so much of it as comes from that of cells. On regular grids theory says 1/2
// and 1/6; these make the volumes of spheres, cylinders and tori right in any position.
constexpr double of_extent = 1.0 / 3, of_cells = 0.2;

// What a vertex or cluster stands for.
struct Patch {
  Vec3 middles, rises;  // sums over its cells: middles of crossings, ways from these to the cells' vertices
  double cells = 0;
  NormalSpread spread;
  bool parts_two = true;
};

std::vector<Patch> patches_of(const QuadSurface& surface) {
  std::vector<Patch> patches(surface.clusters().size());
  const std::vector<DualVertex>& vertices = surface.mesh().vertices;
  for (uint32_t n = 0; n < vertices.size(); ++n) {
    Patch& patch = patches[surface.clusters().of(n)];
    const Vec3 middle = vertices[n].planes.mean();
    patch.middles = patch.middles + middle;
    patch.rises = patch.rises + vertices[n].at - middle;
    ++patch.cells;
    patch.spread.add(vertices[n].spread);
    patch.parts_two &= vertices[n].parts_two;
  }
  return patches;
}

struct Move {
  uint32_t cluster = 0;
  Vec3 from, to, middle;
};

std::vector<Move> moves_of(const QuadSurface& surface) {
  const std::vector<Patch> patches = patches_of(surface);
  std::vector<Move> moves;
  for (uint32_t n = 0; n < patches.size(); ++n) {
    const Patch& patch = patches[n];
    if (patch.cells == 0 || !patch.parts_two || patch.spread.least_cosine() < least_cosine) continue;
    const Vec3 at = surface.clusters().places()[n], middle = (1 / patch.cells) * patch.middles;
    const Vec3 by_cells = (1 / patch.cells) * patch.rises, by_extent = at - middle - by_cells;
    moves.push_back({n, at, at + of_extent * by_extent - of_cells * by_cells, middle});
  }
  return moves;
}

}  // namespace

VolumeFit::VolumeFit(QuadSurface& surface, const Partition& partition, int threads, const StopFlag* stop)
    : from_(surface.clusters().size()) {
  const std::vector<Move> moves = moves_of(surface);
  // A smooth border passes half-way.
  std::vector<Vec3> points;
  for (const Move& move : moves)
    for (const double share : {0.25, 0.75}) points.push_back(move.from + share * (move.middle - move.from));
  const std::vector<Label> labels = labels_at(partition, points, threads, stop);
  for (size_t n = 0; n < moves.size(); ++n) {
    if (labels[2 * n] == labels[2 * n + 1]) continue;
    from_[moves[n].cluster] = moves[n].from;
    surface.place(moves[n].cluster, moves[n].to);
  }
}

bool VolumeFit::undo(QuadSurface& surface, const std::vector<uint32_t>& quads) {
  bool moved = false;
  for (const uint32_t quad : quads)
    for (const uint32_t vertex : surface.mesh().quads[quad].corners) {
      const uint32_t cluster = surface.clusters().of(vertex);
      if (!from_[cluster]) continue;
      surface.place(cluster, *from_[cluster]);
      from_[cluster].reset();
      moved = true;
    }
  return moved;
}

}  // namespace ombre::surface
