#include "surface/mesh/dual_mesh.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "base/system/assert.h"
#include "surface/cells/cell_parts.h"
#include "surface/cells/leaf_parts.h"
#include "surface/mesh/vertex_place.h"

namespace ombre::surface {
namespace {

// Records which pair of regions a part separates; a part of a leaf may separate several pairs.
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

// The crossings around leaves that touch smaller ones, and the part of the leaf that each crossing belongs to.
class TouchedLeaves {
 public:
  TouchedLeaves(const CellTree& tree, const std::vector<Crossing>& crossings)
      : is_touched_(tree.leaves().size()), begins_(tree.leaves().size() + 2) {
    for (const Crossing& crossing : crossings)
      for (const uint32_t leaf : crossing.edge.leaves)
        if (tree.leaves()[leaf].level > crossing.edge.level) is_touched_[leaf] = true;
    for (const Crossing& crossing : crossings) each_touched(crossing, [&](uint32_t leaf) { ++begins_[leaf + 2]; });
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    crossings_.resize(begins_.back());
    for (uint32_t n = 0; n < crossings.size(); ++n)
      each_touched(crossings[n], [&](uint32_t leaf) { crossings_[begins_[leaf + 1]++] = n; });
    parts_.resize(crossings_.size());
  }

  bool has(uint32_t leaf) const { return is_touched_[leaf]; }
  std::span<const uint32_t> around(uint32_t leaf) const {
    return std::span(crossings_).subspan(begins_[leaf], begins_[leaf + 1] - begins_[leaf]);
  }
  void set_parts(uint32_t leaf, const std::vector<uint32_t>& parts) {
    std::ranges::copy(parts, parts_.begin() + begins_[leaf]);
  }
  uint32_t part_of(uint32_t leaf, uint32_t crossing) const {
    const std::span<const uint32_t> all = around(leaf);
    return parts_[begins_[leaf] + static_cast<size_t>(std::ranges::lower_bound(all, crossing) - all.begin())];
  }

 private:
  // Visits the leaves larger than the edge, which occur twice around it, once each.
  template <class Visit>
  void each_touched(const Crossing& crossing, const Visit& visit) const {
    const std::array<uint32_t, 4>& leaves = crossing.edge.leaves;
    for (auto leaf = leaves.begin(); leaf != leaves.end(); ++leaf)
      if (is_touched_[*leaf] && std::find(leaves.begin(), leaf, *leaf) == leaf) visit(*leaf);
  }

  std::vector<bool> is_touched_;
  std::vector<uint32_t> begins_;  // index at which each leaf's entries begin in the next members
  std::vector<uint32_t> crossings_, parts_;
};

class DualMeshMaker {
 public:
  DualMeshMaker(const CellTree& tree, const std::vector<Crossing>& crossings, const Workers& workers)
      : tree_(tree),
        crossings_(crossings),
        workers_(workers),
        touched_(tree, crossings),
        parts_(tree.leaves().size()),
        first_vertex_(tree.leaves().size()) {}

  DualMesh make() {
    add_vertices();
    mesh_.quads.reserve(crossings_.size());
    for (uint32_t n = 0; n < crossings_.size(); ++n) {
      workers_.check_stop_at(n);
      add_quad(n);
    }
    return std::move(mesh_);
  }

 private:
  // Adds one vertex for each part of a leaf.
  struct Part {
    uint32_t leaf = 0;
    bool parts_two = false;
  };

  void add_vertices() {
    constexpr size_t piece = 4096;
    const size_t leaves = tree_.leaves().size();
    std::vector<std::vector<Part>> pieces((leaves + piece - 1) / piece);
    workers_.in_pieces(leaves, piece, [&](size_t begin, size_t end) {
      std::vector<Part>& found = pieces[begin / piece];
      for (size_t n = begin; n < end; ++n) {
        first_vertex_[n] = static_cast<uint32_t>(found.size());
        find_parts(static_cast<uint32_t>(n), found);
      }
    });
    mesh_.vertices.reserve(leaves);
    for (size_t p = 0; p < pieces.size(); ++p) {
      workers_.check_stop();
      const auto before = static_cast<uint32_t>(mesh_.vertices.size());
      for (size_t n = p * piece; n < std::min((p + 1) * piece, leaves); ++n) first_vertex_[n] += before;
      for (const Part& part : pieces[p]) mesh_.vertices.push_back({part.leaf, part.parts_two, {}, {}, {}});
    }
  }

  void find_parts(uint32_t number, std::vector<Part>& found) {
    if (touched_.has(number)) return find_parts_of_touched(number, found);
    const Leaf& leaf = tree_.leaves()[number];
    const CellParts parts = find_cell_parts(leaf.corners);
    std::array<PairsOfParts, 12> pairs;
    for (int e = 0; e < 12; ++e)
      if (leaf.crosses(e))
        pairs[parts.part_of_edge[static_cast<size_t>(e)]].note(leaf.corners[first_corner(e)],
                                                               leaf.corners[second_corner(e)]);
    for (size_t part = 0; part < parts.count; ++part) found.push_back({number, pairs[part].is_one()});
    parts_[number] = parts;
  }

  void find_parts_of_touched(uint32_t number, std::vector<Part>& found) {
    const std::span<const uint32_t> around = touched_.around(number);
    const std::vector<uint32_t> parts = find_leaf_parts(tree_, tree_.leaves()[number], crossings_, around);
    std::vector<PairsOfParts> pairs(std::ranges::max(parts) + 1);
    for (size_t n = 0; n < around.size(); ++n)
      pairs[parts[n]].note(crossings_[around[n]].edge.from, crossings_[around[n]].edge.to);
    for (const PairsOfParts& pair : pairs) found.push_back({number, pair.is_one()});
    touched_.set_parts(number, parts);
  }

  void add_quad(uint32_t number) {
    const Crossing& crossing = crossings_[number];
    DualQuad quad{number, {}};
    for (size_t corner = 0; corner < 4; ++corner) {
      const uint32_t leaf = crossing.edge.leaves[corner];
      ASSERT(leaf != CellTree::none);
      quad.corners[corner] = first_vertex_[leaf] + part_of(number, corner);
      if (std::ranges::find(quad.corners, quad.corners[corner]) != quad.corners.begin() + corner) continue;
      DualVertex& vertex = mesh_.vertices[quad.corners[corner]];
      vertex.planes.add(crossing.at, crossing.normal);
      vertex.spread.add(crossing.edge.from < crossing.edge.to ? crossing.normal : -crossing.normal);
    }
    mesh_.quads.push_back(quad);
  }

  uint32_t part_of(uint32_t number, size_t corner) const {
    const CrossedEdge& edge = crossings_[number].edge;
    const uint32_t leaf = edge.leaves[corner];
    if (touched_.has(leaf)) return touched_.part_of(leaf, number);
    const int in_leaf = edge_number(edge.axis, quad_offsets[corner][0], quad_offsets[corner][1]);
    return parts_[leaf].part_of_edge[static_cast<size_t>(in_leaf)];
  }

  const CellTree& tree_;
  const std::vector<Crossing>& crossings_;
  const Workers& workers_;
  TouchedLeaves touched_;
  std::vector<CellParts> parts_;  // parts of the leaves that touch no smaller ones
  std::vector<uint32_t> first_vertex_;
  DualMesh mesh_;
};

// Copies the vertices of leaves that are far from the growth.
void take_over_places(const CellTree& tree, const DualMesh& before, const std::vector<uint32_t>& leaves,
                      DualMesh& mesh) {
  size_t next = 0;
  for (const DualVertex& vertex : before.vertices) {
    const uint32_t leaf = leaves[vertex.leaf];
    if (leaf == CellTree::none || tree.leaves()[leaf].is_near_growth) continue;
    while (mesh.vertices[next].leaf != leaf) ++next;
    mesh.vertices[next++].at = vertex.at;
  }
}

template <class Which>
void find_places(const CellTree& tree, DualMesh& mesh, const Workers& workers, const Which& is_unknown) {
  constexpr size_t piece = 8192;
  workers.in_pieces(mesh.vertices.size(), piece, [&](size_t begin, size_t end) {
    for (size_t n = begin; n < end; ++n)
      if (is_unknown(mesh.vertices[n])) mesh.vertices[n].at = place_of(mesh.vertices[n], tree);
  });
}

}  // namespace

DualMesh make_dual_mesh(const CellTree& tree, const std::vector<Crossing>& crossings, const Workers& workers) {
  DualMesh mesh = DualMeshMaker(tree, crossings, workers).make();
  find_places(tree, mesh, workers, [](const DualVertex&) { return true; });
  return mesh;
}

DualMesh make_dual_mesh_after_growth(const CellTree& tree, const std::vector<Crossing>& crossings,
                                     const DualMesh& before, const std::vector<uint32_t>& leaves,
                                     const Workers& workers) {
  DualMesh mesh = DualMeshMaker(tree, crossings, workers).make();
  take_over_places(tree, before, leaves, mesh);
  find_places(tree, mesh, workers, [&](const DualVertex& vertex) { return tree.leaves()[vertex.leaf].is_near_growth; });
  return mesh;
}

}  // namespace ombre::surface
