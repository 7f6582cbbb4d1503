// Finds the borders of regions in one layer as chains.
#include "surface/outline/outline_chains.h"

namespace ombre::surface {
namespace {

class ChainFinder {
 public:
  explicit ChainFinder(const OutlineGraph& graph) : graph_(graph), is_used_(graph.crossings.size()) {}

  std::vector<OutlineChain> find() {
    for (uint32_t v = 0; v < graph_.vertices.size(); ++v) {
      const OutlineVertex& vertex = graph_.vertices[v];
      if (!vertex.is_junction()) continue;
      for (size_t n = 0; n < vertex.count; ++n)
        if (!is_used_[vertex.crossings[n]]) trace(v, vertex.crossings[n]);
    }
    // The remaining chains meet no junction.
    for (uint32_t c = 0; c < graph_.crossings.size(); ++c)
      if (!is_used_[c]) trace(graph_.crossings[c].ends[0], c);
    return std::move(chains_);
  }

 private:
  void trace(uint32_t start, uint32_t c) {
    const OutlineCrossing& first = graph_.crossings[c];
    const bool is_forward = first.ends[0] == start;
    OutlineChain chain{is_forward ? first.from : first.to, is_forward ? first.to : first.from, {start}};
    for (uint32_t at = start;;) {
      is_used_[c] = true;
      const auto& ends = graph_.crossings[c].ends;
      at = ends[0] == at ? ends[1] : ends[0];
      chain.nodes.push_back(static_cast<uint32_t>(graph_.vertices.size()) + c);
      chain.nodes.push_back(at);
      const OutlineVertex& vertex = graph_.vertices[at];
      if (at == start || vertex.is_junction()) break;
      c = vertex.crossings[0] == c ? vertex.crossings[1] : vertex.crossings[0];
    }
    chains_.push_back(std::move(chain));
  }

  const OutlineGraph& graph_;
  std::vector<bool> is_used_;
  std::vector<OutlineChain> chains_;
};

}  // namespace

std::vector<OutlineChain> find_chains(const OutlineGraph& graph) { return ChainFinder(graph).find(); }

}  // namespace ombre::surface
