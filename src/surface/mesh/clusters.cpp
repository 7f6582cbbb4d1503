#include "surface/mesh/clusters.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "surface/mesh/vertex_place.h"

namespace ombre::surface {
namespace {

// Limit for the rms distance to the planes, as a share of the tolerance; the greatest distance is about three times the
// rms.
constexpr double rms_share = 0.3;

int level_of(int32_t index) { return index == 0 ? 31 : std::countr_zero(static_cast<uint32_t>(index)); }

// A quad with the axis of its edge and the levels of the two lattice planes that contain the edge: a plane of level n
// is a boundary of cells of sides up to 2^n units. Stored compactly, because crossings are large and scattered in
// memory.
struct LevelQuad {
  uint32_t number = 0;
  uint8_t axis = 0, u = 0, v = 0;
};

// Data of clusters that may be joined into one.
struct Candidate {
  std::vector<uint32_t> members;
  int euler = 0;           // Euler characteristic of their part of the surface; 1 for a disc
  int inner_arc_ends = 0;  // number of ends of arcs in which members meet
  uint16_t crossed_edges = 0;
  bool crosses_twice = false, is_blocked = false;
  Quadric planes;
  NormalSpread spread;
};

// Returns for each face of a cell its edges as bits.
constexpr std::array<uint16_t, 6> edges_of_faces() {
  std::array<uint16_t, 6> faces{};
  for (size_t face = 0; face < 6; ++face)
    for (int n = 0; n < 2; ++n) {
      const int axis = static_cast<int>(face) / 2, side = static_cast<int>(face) % 2;
      faces[face] = static_cast<uint16_t>(faces[face] | 1 << edge_number((axis + 1) % 3, n, side) |
                                          1 << edge_number((axis + 2) % 3, side, n));
    }
  return faces;
}

bool borders_are_simple(uint16_t crossed) {
  static constexpr auto faces = edges_of_faces();
  if (std::popcount(crossed) < 3) return false;
  return std::ranges::all_of(faces, [&](uint16_t face) { return std::popcount<uint16_t>(crossed & face) <= 2; });
}

class LevelBuilder {
 public:
  LevelBuilder(const CellTree& tree, const std::vector<Crossing>& crossings, const DualMesh& mesh, double tolerance_mm,
               const Workers& workers, ClusterList& list)
      : tree_(tree), mesh_(mesh), tolerance_mm_(tolerance_mm), workers_(workers), list_(list), clusters_(list.all) {
    for (const DualVertex& vertex : mesh.vertices) {
      euler_.push_back(1);
      may_join_.push_back(vertex.parts_two);
    }
    tops_.resize(mesh.vertices.size());
    std::iota(tops_.begin(), tops_.end(), uint32_t{0});
    for (uint32_t n = 0; n < mesh.quads.size(); ++n) {
      const CrossedEdge& edge = crossings[mesh.quads[n].crossing].edge;
      const auto level = [&](unsigned turn) {
        return static_cast<uint8_t>(level_of(edge.start[(edge.axis + turn) % 3]));
      };
      later_quads_[edge.level].push_back({n, static_cast<uint8_t>(edge.axis), level(1), level(2)});
    }
  }

  // Joins clusters into cells of a level. Returns false if nothing is left to join.
  bool build(int level) {
    level_ = level;
    for (uint32_t n = 0; n < mesh_.vertices.size(); ++n)
      if (clusters_[n].level == level - 1) fresh_.push_back(n);
    if (level <= grid_level + 1) {
      const std::vector<LevelQuad>& quads = later_quads_[static_cast<size_t>(level - 1)];
      quads_.insert(quads_.end(), quads.begin(), quads.end());
    }
    std::erase_if(quads_, [&](const LevelQuad& q) { return std::max(q.u, q.v) < level - 1; });
    gather();
    note_points();
    workers_.check_stop();
    note_crossed_edges();
    make_clusters();
    for (uint32_t& top : tops_)
      if (clusters_[top].parent != Cluster::none) top = clusters_[top].parent;
    return !fresh_.empty() || level <= grid_level;
  }

 private:
  std::array<uint32_t, 4> tops(const LevelQuad& quad) const {
    std::array<uint32_t, 4> found{};
    for (size_t n = 0; n < 4; ++n) found[n] = tops_[mesh_.quads[quad.number].corners[n]];
    return found;
  }
  bool is_fresh(uint32_t cluster) const { return clusters_[cluster].level == level_ - 1; }

  // Groups the clusters that are connected inside a cell of this level.
  void gather() {
    group_.assign(clusters_.size(), Cluster::none);
    for (const uint32_t c : fresh_) group_[c] = c;
    arc_ends_.clear();
    blocked_.clear();
    for (const LevelQuad& q : quads_) {
      const auto t = tops(q);
      for (size_t side = 0; side < 4; ++side)
        if ((side % 2 == 0 ? q.u : q.v) == level_ - 1) hang_together(t[side], t[(side + 1) % 4]);
    }
    collect();
  }

  void hang_together(uint32_t a, uint32_t b) {
    if (!is_fresh(a) || !is_fresh(b)) {
      if (is_fresh(a)) blocked_.push_back(a);
      if (is_fresh(b)) blocked_.push_back(b);
      return;
    }
    arc_ends_.push_back(a);
    const uint32_t ga = find(a), gb = find(b);
    group_[std::max(ga, gb)] = std::min(ga, gb);
  }

  uint32_t find(uint32_t c) {
    while (group_[c] != c) c = group_[c] = group_[group_[c]];
    return c;
  }

  const Quadric& planes(uint32_t c) const {
    return c < mesh_.vertices.size() ? mesh_.vertices[c].planes : planes_[c - mesh_.vertices.size()];
  }
  const NormalSpread& spread(uint32_t c) const {
    return c < mesh_.vertices.size() ? mesh_.vertices[c].spread : spreads_[c - mesh_.vertices.size()];
  }

  void collect() {
    candidates_.clear();
    candidates_.reserve(static_cast<size_t>(std::ranges::count_if(fresh_, [&](uint32_t c) { return group_[c] == c; })));
    number_.assign(clusters_.size(), Cluster::none);
    for (size_t n = 0; n < fresh_.size(); ++n) {
      workers_.check_stop_at(n);
      const uint32_t c = fresh_[n], g = find(c);
      if (number_[g] == Cluster::none) {
        number_[g] = static_cast<uint32_t>(candidates_.size());
        candidates_.emplace_back();
      }
      number_[c] = number_[g];
      Candidate& candidate = candidates_[number_[g]];
      candidate.members.push_back(c);
      candidate.planes.add(planes(c));
      candidate.spread.add(spread(c));
      candidate.euler += euler_[c];
      candidate.is_blocked |= !may_join_[c];
    }
    for (const uint32_t c : blocked_) candidates_[number_[c]].is_blocked = true;
    for (const uint32_t c : arc_ends_) ++candidates_[number_[c]].inner_arc_ends;
  }

  Candidate* candidate_of(uint32_t cluster) {
    return number_[cluster] == Cluster::none ? nullptr : &candidates_[number_[cluster]];
  }

  // Counts the points at which four members meet or several arcs pass.
  void note_points() {
    for (const LevelQuad& q : quads_) {
      if (std::max(q.u, q.v) != level_ - 1) continue;
      if (Candidate* candidate = candidate_of(tops_[mesh_.quads[q.number].corners[0]])) ++candidate->euler;
    }
  }

  void note_crossed_edges() {
    for (const LevelQuad& q : quads_) {
      if (std::min(q.u, q.v) < level_) continue;
      const auto t = tops(q);
      for (size_t n = 0; n < 4; ++n) {
        Candidate* candidate = candidate_of(t[n]);
        if (!candidate) continue;
        const auto bit = static_cast<uint16_t>(1 << edge_number(q.axis, quad_offsets[n][0], quad_offsets[n][1]));
        candidate->crosses_twice |= (candidate->crossed_edges & bit) != 0;
        candidate->crossed_edges |= bit;
      }
    }
  }

  // Returns the points nearest to the planes of each candidate that is not blocked.
  std::vector<Quadric::Least> find_least() const {
    constexpr size_t piece = 4096;
    std::vector<Quadric::Least> least(candidates_.size());
    workers_.in_pieces(least.size(), piece, [&](size_t begin, size_t end) {
      for (size_t n = begin; n < end; ++n)
        if (!candidates_[n].is_blocked) least[n] = candidates_[n].planes.least();
    });
    return least;
  }

  // Makes a cluster of each candidate within the tolerance. A cluster that is not a disc is marked as split: its
  // members stay, but it may become part of a disc one level up.
  void make_clusters() {
    std::vector<uint32_t> made;
    const std::vector<Quadric::Least> leasts = find_least();
    for (size_t n = 0; n < candidates_.size(); ++n) {
      workers_.check_stop_at(n);
      const Candidate& candidate = candidates_[n];
      const Quadric::Least& least = leasts[n];
      if (candidate.is_blocked) continue;
      if (least.rms_mm > candidate.spread.most_rms(rms_share) * tolerance_mm_) continue;
      CellPlace place = clusters_[candidate.members[0]].place;
      for (int32_t& index : place) index >>= 1;
      // Every arc is counted by two quads.
      const int euler = candidate.euler - candidate.inner_arc_ends / 2;
      const bool is_simple = euler == 1 && !candidate.crosses_twice && borders_are_simple(candidate.crossed_edges) &&
                             room_of(tree_, place, level_).contains(least.at);
      const auto number = static_cast<uint32_t>(clusters_.size());
      for (const uint32_t member : candidate.members) clusters_[member].parent = number;
      clusters_.push_back({place, static_cast<uint8_t>(level_), !is_simple, Cluster::none,
                           static_cast<uint32_t>(list_.members.size()),
                           static_cast<uint32_t>(candidate.members.size())});
      list_.places.push_back(least.at);
      list_.members.insert(list_.members.end(), candidate.members.begin(), candidate.members.end());
      planes_.push_back(candidate.planes);
      spreads_.push_back(candidate.spread);
      euler_.push_back(euler);
      may_join_.push_back(true);
      made.push_back(number);
    }
    fresh_ = std::move(made);
  }

  const CellTree& tree_;
  const DualMesh& mesh_;
  double tolerance_mm_;
  const Workers& workers_;
  ClusterList& list_;
  std::vector<Cluster>& clusters_;
  int level_ = 0;
  std::vector<Quadric> planes_;        // planes of the joined clusters
  std::vector<NormalSpread> spreads_;  // normal spreads of the joined clusters
  std::vector<int> euler_;
  std::vector<bool> may_join_;
  std::vector<uint32_t> tops_;                                      // by vertex: the topmost cluster above it
  std::array<std::vector<LevelQuad>, grid_level + 1> later_quads_;  // by level of their edges
  std::vector<LevelQuad> quads_;
  std::vector<uint32_t> fresh_, group_, number_, blocked_, arc_ends_;
  std::vector<Candidate> candidates_;
};

}  // namespace

Clusters::Clusters(const CellTree& tree, const std::vector<Crossing>& crossings, const DualMesh& mesh,
                   double tolerance_mm, const Workers& workers)
    : vertices_(mesh.vertices.size()) {
  int lowest = grid_level;
  for (const DualVertex& vertex : mesh.vertices) {
    const Leaf& leaf = tree.leaves()[vertex.leaf];
    const CellPlace place{leaf.at[0] >> leaf.level, leaf.at[1] >> leaf.level, leaf.at[2] >> leaf.level};
    list_.all.push_back({place, leaf.level});
    list_.places.push_back(vertex.at);
    lowest = std::min<int>(lowest, leaf.level);
  }
  if (tolerance_mm > 0) {
    LevelBuilder builder(tree, crossings, mesh, tolerance_mm, workers, list_);
    const auto& count = tree.lattice().count;
    const auto longest = static_cast<uint64_t>(std::max({count[0], count[1], count[2]}));
    // At the level at which one cell holds the whole grid, nothing is left to join.
    const int levels = grid_level + static_cast<int>(std::bit_width(longest));
    for (int level = lowest + 1; level <= levels && builder.build(level); ++level) {
    }
  }
  stands_for_.resize(vertices_);
  for (uint32_t vertex = 0; vertex < vertices_; ++vertex) {
    stands_for_[vertex] = vertex;
    for (uint32_t c = list_.all[vertex].parent; c != Cluster::none; c = list_.all[c].parent)
      if (!list_.all[c].is_split) stands_for_[vertex] = c;
  }
}

void Clusters::split(uint32_t cluster, std::vector<uint32_t>& vertices) {
  Cluster& split = list_.all[cluster];
  if (split.is_split) return;
  split.is_split = true;
  let_stand(Cluster::none, cluster, vertices);
}

// Makes `cluster` represent all vertices below `below`; if it is none, the first cluster below that is not split does.
void Clusters::let_stand(uint32_t cluster, uint32_t below, std::vector<uint32_t>& vertices) {
  const Cluster& c = list_.all[below];
  if (cluster == Cluster::none && !c.is_split) cluster = below;
  if (!is_joined(below)) {
    stands_for_[below] = cluster;
    vertices.push_back(below);
  }
  for (uint32_t n = 0; n < c.member_count; ++n) let_stand(cluster, list_.members[c.first_member + n], vertices);
}

}  // namespace ombre::surface
