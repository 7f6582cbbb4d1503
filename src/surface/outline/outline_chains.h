// Borders of regions in one layer as chains. A chain runs from one junction of more than two regions to the next, or
// around.
#pragma once

#include <vector>

#include "surface/outline/outline_cells.h"

namespace ombre::surface {

// The border between two regions. A closed chain, which meets no third region, repeats its first node.
struct OutlineChain {
  Label left = 0, right = 0;
  std::vector<uint32_t> nodes;
  bool is_closed() const { return nodes.front() == nodes.back(); }
};

// True if a node is a crossing; nodes below vertices.size() are vertices.
inline bool is_crossing(const OutlineGraph& graph, uint32_t node) { return node >= graph.vertices.size(); }
inline Vec2 point_of(const OutlineGraph& graph, uint32_t node) {
  return is_crossing(graph, node) ? graph.crossings[node - graph.vertices.size()].at : graph.vertices[node].at;
}

// Returns all chains. Vertices and crossings alternate in each.
std::vector<OutlineChain> find_chains(const OutlineGraph& graph);

}  // namespace ombre::surface
