// Borders of regions in one layer as chains: from one place where more than two regions meet to the next, or around.
#pragma once

#include <vector>

#include "surface/outline/outline_cells.h"

namespace ombre::surface {

// Two regions and the points between them. What is closed and meets no third region repeats its first point.
struct OutlineChain {
  Label left = 0, right = 0;
  std::vector<uint32_t> nodes;
  bool is_closed() const { return nodes.front() == nodes.back(); }
};

// A node is a vertex, or behind them a crossing.
inline bool is_crossing(const OutlineGraph& graph, uint32_t node) { return node >= graph.vertices.size(); }
inline Vec2 point_of(const OutlineGraph& graph, uint32_t node) {
  return is_crossing(graph, node) ? graph.crossings[node - graph.vertices.size()].at : graph.vertices[node].at;
}

// Vertices and crossings take turns.
std::vector<OutlineChain> find_chains(const OutlineGraph& graph);

}  // namespace ombre::surface
