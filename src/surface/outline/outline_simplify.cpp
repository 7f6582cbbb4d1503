#include "surface/outline/outline_simplify.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/math/line_simplification.h"
#include "surface/outline/outline_crossings.h"
#include "surface/outline/outline_overlaps.h"

namespace ombre::surface {
namespace {

constexpr int most_simplifying_rounds = 12;  // halvings of the tolerance

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a, to = p - a;
  const double length2 = dot(along, along);
  const double share = length2 > 0 ? std::clamp(dot(to, along) / length2, 0.0, 1.0) : 0;
  return std::hypot(to.x - share * along.x, to.y - share * along.y);
}

std::vector<uint32_t> thinned(const OutlineGraph& graph, const std::vector<uint32_t>& nodes, double tolerance) {
  const auto point = [&](size_t n) { return point_of(graph, nodes[n]); };
  const std::vector<bool> kept = kept_points(nodes.size(), tolerance, [&](size_t n, size_t begin, size_t end) {
    return distance_to_segment(point(n), point(begin), point(end));
  });
  std::vector<uint32_t> left;
  for (size_t n = 0; n < nodes.size(); ++n)
    if (kept[n]) left.push_back(nodes[n]);
  return left;
}

// Rotates a ring so that it begins at its point farthest from its former beginning, a point that every simplification
// keeps.
void turn_ring(const OutlineGraph& graph, OutlineChain& ring) {
  const Vec2 from = point_of(graph, ring.nodes.front());
  const auto farther = [&](uint32_t a, uint32_t b) {
    const Vec2 p = point_of(graph, a) - from, q = point_of(graph, b) - from;
    return dot(p, p) < dot(q, q);
  };
  ring.nodes.pop_back();
  std::rotate(ring.nodes.begin(), std::ranges::max_element(ring.nodes, farther), ring.nodes.end());
  ring.nodes.push_back(ring.nodes.front());
}

bool is_ring(const OutlineGraph& graph, const OutlineChain& chain) {
  return chain.is_closed() && !graph.vertices[chain.nodes.front()].is_junction();
}

bool goes_back(const OutlineGraph& graph, uint32_t a, uint32_t b, uint32_t c) {
  return dot(point_of(graph, b) - point_of(graph, a), point_of(graph, c) - point_of(graph, b)) < 0;
}

void leave_out_hairpins_ahead(const voxel::Lattice& corners, const OutlineGraph& graph, std::vector<uint32_t>& nodes) {
  std::vector<uint32_t> kept{nodes.front()};
  for (size_t n = 1; n < nodes.size(); ++n) {
    const uint32_t last = kept.back();
    const bool is_outside = !is_crossing(graph, last) && !is_in_cell(corners, graph.vertices[last]);
    const bool is_hairpin = is_outside && n + 1 < nodes.size() && goes_back(graph, last, nodes[n], nodes[n + 1]);
    if (!is_hairpin) kept.push_back(nodes[n]);
  }
  nodes = std::move(kept);
}

// Removes hairpins: a vertex outside of its cell may lie beyond the next points of its chain.
void leave_out_hairpins(const voxel::Lattice& corners, const OutlineGraph& graph, std::vector<OutlineChain>& chains) {
  for (OutlineChain& chain : chains)
    for (int way = 0; way < 2; ++way) {
      leave_out_hairpins_ahead(corners, graph, chain.nodes);
      std::ranges::reverse(chain.nodes);
    }
}

class Untangler {
 public:
  Untangler(const voxel::Lattice& corners, OutlineGraph& graph)
      : corners_(corners), graph_(graph), places_(graph.vertices.size(), Place::best) {}

  // Moves the vertices of overlapping segments back to their cells. Returns false if no vertex could be moved.
  bool draw_in(const std::vector<std::pair<ChainSegment, ChainSegment>>& overlaps) {
    std::set<uint32_t> nodes;
    for (const auto& [s, o] : overlaps) nodes.insert({s.a, s.b, o.a, o.b});
    bool has_changed = false;
    for (const uint32_t node : nodes) has_changed = draw_in(node) || has_changed;
    return has_changed;
  }

 private:
  enum class Place : uint8_t { best, on_cell, mean };

  bool draw_in(uint32_t node) {
    if (is_crossing(graph_, node) || places_[node] == Place::mean) return false;
    OutlineVertex& vertex = graph_.vertices[node];
    const bool goes_on_cell = places_[node] == Place::best && !is_in_cell(corners_, vertex);
    places_[node] = goes_on_cell ? Place::on_cell : Place::mean;
    vertex.at = goes_on_cell ? point_on_cell(corners_, graph_, vertex) : mean_point(graph_, vertex);
    return true;
  }

  const voxel::Lattice& corners_;
  OutlineGraph& graph_;
  std::vector<Place> places_;
};

bool has_collapsed(const OutlineChain& chain) { return chain.is_closed() && chain.nodes.size() < 4; }

}  // namespace

std::vector<OutlineChain> untangle(const voxel::Lattice& corners, OutlineGraph& graph) {
  const std::vector<OutlineChain> full = find_chains(graph);
  Untangler untangler(corners, graph);
  for (;;) {
    std::vector<OutlineChain> chains = full;
    leave_out_hairpins(corners, graph, chains);
    if (!untangler.draw_in(find_overlaps(graph, chains))) return chains;
  }
}

std::vector<OutlineChain> simplify(const OutlineGraph& graph, const std::vector<OutlineChain>& chains,
                                   double tolerance_mm) {
  std::vector<OutlineChain> full = chains;
  for (OutlineChain& chain : full)
    if (is_ring(graph, chain)) turn_ring(graph, chain);
  std::vector<OutlineChain> simple = full;
  std::vector<bool> is_wrong(chains.size(), true);
  for (int round = 0; round < most_simplifying_rounds; ++round) {
    const double tolerance = std::ldexp(tolerance_mm, -round);
    for (size_t n = 0; n < full.size(); ++n)
      if (is_wrong[n]) simple[n].nodes = thinned(graph, full[n].nodes, tolerance);
    is_wrong.assign(chains.size(), false);
    for (const auto& [s, o] : find_overlaps(graph, simple)) is_wrong[s.chain] = is_wrong[o.chain] = true;
    for (size_t n = 0; n < simple.size(); ++n)
      if (has_collapsed(simple[n])) is_wrong[n] = true;
    if (std::ranges::none_of(is_wrong, [](bool wrong) { return wrong; })) break;
  }
  return simple;
}

}  // namespace ombre::surface
