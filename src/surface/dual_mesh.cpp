#include "surface/dual_mesh.h"

#include <algorithm>
#include <unordered_map>

#include "base/assert.h"
#include "base/tasks.h"
#include "surface/cell_parts.h"
#include "surface/leaf_parts.h"
#include "surface/vertex_place.h"

namespace ombre::surface {
namespace {

// What two regions meet on an edge; a leaf's part may see several such pairs.
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

// The crossings around leaves that smaller ones touch.
std::unordered_map<uint32_t, std::vector<uint32_t>> crossings_of_touched(const CellTree& tree,
                                                                         const std::vector<Crossing>& crossings) {
  std::unordered_map<uint32_t, std::vector<uint32_t>> around;
  const auto& leaves = tree.leaves();
  for (const Crossing& crossing : crossings)
    for (const uint32_t leaf : crossing.edge.leaves)
      if (leaves[leaf].level > crossing.edge.level) around[leaf];
  if (around.empty()) return around;
  for (uint32_t n = 0; n < crossings.size(); ++n)
    for (const uint32_t leaf : crossings[n].edge.leaves) {
      const auto found = leaves[leaf].is_near_cut ? around.find(leaf) : around.end();
      if (found != around.end() && (found->second.empty() || found->second.back() != n)) found->second.push_back(n);
    }
  return around;
}

class DualMeshMaker {
 public:
  DualMeshMaker(const CellTree& tree, const std::vector<Crossing>& crossings)
      : tree_(tree),
        crossings_(crossings),
        touched_(crossings_of_touched(tree, crossings)),
        parts_(tree.leaves().size()) {
    mesh_.vertices.reserve(tree.leaves().size());
    first_vertex_.reserve(tree.leaves().size());
  }

  DualMesh make() {
    for (uint32_t n = 0; n < tree_.leaves().size(); ++n) {
      first_vertex_.push_back(static_cast<uint32_t>(mesh_.vertices.size()));
      const auto found = tree_.leaves()[n].is_near_cut ? touched_.find(n) : touched_.end();
      if (found == touched_.end())
        add_vertices(n);
      else
        add_vertices_of_touched(n, found->second);
    }
    mesh_.quads.reserve(crossings_.size());
    for (uint32_t n = 0; n < crossings_.size(); ++n) add_quad(n);
    return std::move(mesh_);
  }

 private:
  void add_vertices(uint32_t number) {
    const Leaf& leaf = tree_.leaves()[number];
    const CellParts parts = find_cell_parts(leaf.corners);
    std::array<PairsOfParts, 12> pairs;
    for (int e = 0; e < 12; ++e)
      if (leaf.crosses(e))
        pairs[parts.part_of_edge[static_cast<size_t>(e)]].note(leaf.corners[first_corner(e)],
                                                               leaf.corners[second_corner(e)]);
    for (size_t part = 0; part < parts.count; ++part)
      mesh_.vertices.push_back({number, pairs[part].is_one(), {}, {}, {}});
    parts_[number] = parts;
  }

  void add_vertices_of_touched(uint32_t number, const std::vector<uint32_t>& around) {
    const std::vector<uint32_t> parts = find_leaf_parts(tree_, tree_.leaves()[number], crossings_, around);
    std::vector<PairsOfParts> pairs(std::ranges::max(parts) + 1);
    for (size_t n = 0; n < around.size(); ++n)
      pairs[parts[n]].note(crossings_[around[n]].edge.from, crossings_[around[n]].edge.to);
    for (const PairsOfParts& pair : pairs) mesh_.vertices.push_back({number, pair.is_one(), {}, {}, {}});
    parts_of_touched_.emplace(number, parts);
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
    const auto found = tree_.leaves()[leaf].is_near_cut ? touched_.find(leaf) : touched_.end();
    if (found != touched_.end()) {
      const auto at = std::ranges::lower_bound(found->second, number) - found->second.begin();
      return parts_of_touched_.at(leaf)[static_cast<size_t>(at)];
    }
    const int in_leaf = edge_number(edge.axis, quad_offsets[corner][0], quad_offsets[corner][1]);
    return parts_[leaf].part_of_edge[static_cast<size_t>(in_leaf)];
  }

  const CellTree& tree_;
  const std::vector<Crossing>& crossings_;
  const std::unordered_map<uint32_t, std::vector<uint32_t>> touched_;
  std::unordered_map<uint32_t, std::vector<uint32_t>> parts_of_touched_;
  std::vector<CellParts> parts_;  // of the others
  std::vector<uint32_t> first_vertex_;
  DualMesh mesh_;
};

// A leaf far from cuts has the vertices that it had.
void take_over_places(const CellTree& tree, const DualMesh& before, const std::vector<uint32_t>& leaves,
                      DualMesh& mesh) {
  size_t next = 0;
  for (const DualVertex& vertex : before.vertices) {
    const uint32_t leaf = leaves[vertex.leaf];
    if (leaf == CellTree::none || tree.leaves()[leaf].is_near_cut) continue;
    while (mesh.vertices[next].leaf != leaf) ++next;
    mesh.vertices[next++].at = vertex.at;
  }
}

template <class Which>
void find_places(const CellTree& tree, DualMesh& mesh, int threads, const Which& is_unknown) {
  constexpr size_t piece = 8192;
  run_parallel((mesh.vertices.size() + piece - 1) / piece, threads, [&](size_t p) {
    for (size_t n = p * piece; n < std::min((p + 1) * piece, mesh.vertices.size()); ++n)
      if (is_unknown(mesh.vertices[n])) mesh.vertices[n].at = place_of(mesh.vertices[n], tree);
  });
}

}  // namespace

DualMesh make_dual_mesh(const CellTree& tree, const std::vector<Crossing>& crossings, int threads) {
  DualMesh mesh = DualMeshMaker(tree, crossings).make();
  find_places(tree, mesh, threads, [](const DualVertex&) { return true; });
  return mesh;
}

DualMesh make_dual_mesh_after_growth(const CellTree& tree, const std::vector<Crossing>& crossings,
                                     const DualMesh& before, const std::vector<uint32_t>& leaves, int threads) {
  DualMesh mesh = DualMeshMaker(tree, crossings).make();
  take_over_places(tree, before, leaves, mesh);
  find_places(tree, mesh, threads, [&](const DualVertex& vertex) { return tree.leaves()[vertex.leaf].is_near_cut; });
  return mesh;
}

}  // namespace ombre::surface
