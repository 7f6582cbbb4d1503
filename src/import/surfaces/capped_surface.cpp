// Closes the gaps of a surface, so that winding numbers become whole.
#include "import/surfaces/capped_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "formats/mesh/vertex_merger.h"

namespace ombre::importing {
namespace {

using Edge = std::array<uint32_t, 2>;  // from, to

std::vector<Edge> edges_of(const Surface& surface) {
  std::vector<Edge> edges;
  edges.reserve(3 * surface.triangles.size());
  for (const auto& t : surface.triangles)
    for (size_t i = 0; i < 3; ++i)
      if (const uint32_t from = t[i], to = t[i == 2 ? 0 : i + 1]; from != to) edges.push_back({from, to});
  return edges;
}

// Returns the edges that would have to be added so that each edge occurs equally often in both directions.
std::vector<Edge> missing_edges(std::vector<Edge> edges) {
  const auto sorted = [](Edge e) { return Edge{std::min(e[0], e[1]), std::max(e[0], e[1])}; };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return sorted(a) < sorted(b); });
  std::vector<Edge> missing;
  for (size_t i = 0; i < edges.size();) {
    const Edge edge = sorted(edges[i]);
    int64_t balance = 0;
    for (; i < edges.size() && sorted(edges[i]) == edge; ++i) balance += edges[i] == edge ? 1 : -1;
    for (; balance > 0; --balance) missing.push_back({edge[1], edge[0]});
    for (; balance < 0; ++balance) missing.push_back(edge);
  }
  std::sort(missing.begin(), missing.end());
  return missing;
}

// Decomposes edges, of which as many begin as end in each vertex, into loops that pass no vertex twice.
class LoopTracer {
 public:
  LoopTracer(const std::vector<Edge>& edges, size_t vertices) : edges_(edges), next_(vertices), place_(vertices, none) {
    for (size_t v = 0, e = 0; v < vertices; ++v) {
      next_[v] = e;
      while (e < edges.size() && edges[e][0] == v) ++e;
    }
  }

  std::vector<std::vector<uint32_t>> loops() {
    for (size_t e = 0; e < edges_.size(); ++e) {
      const uint32_t start = edges_[e][0];
      if (next_[start] <= e) trace_from(start);
    }
    return std::move(loops_);
  }

 private:
  static constexpr size_t none = SIZE_MAX;

  bool has_edge(uint32_t vertex) const { return next_[vertex] < edges_.size() && edges_[next_[vertex]][0] == vertex; }

  void trace_from(uint32_t vertex) {
    while (true) {
      if (place_[vertex] != none) cut_loop(vertex);
      if (!has_edge(vertex)) break;
      place_[vertex] = path_.size();
      path_.push_back(vertex);
      vertex = edges_[next_[vertex]++][1];
    }
  }

  // Cuts the loop that closes at this vertex off the path.
  void cut_loop(uint32_t vertex) {
    const auto first = path_.begin() + static_cast<std::ptrdiff_t>(place_[vertex]);
    loops_.emplace_back(first, path_.end());
    for (const uint32_t v : loops_.back()) place_[v] = none;
    path_.erase(first, path_.end());
  }

  const std::vector<Edge>& edges_;
  std::vector<size_t> next_;   // by vertex: index of its next edge to leave by
  std::vector<size_t> place_;  // by vertex: its index on the path, or none
  std::vector<uint32_t> path_;
  std::vector<std::vector<uint32_t>> loops_;
};

// Returns the middle of the rim's edges, weighted by their lengths.
Vec3 middle(const std::vector<Vec3>& rim) {
  Vec3 weighted, plain;
  double total = 0;
  for (size_t i = 0; i < rim.size(); ++i) {
    const Vec3& next = rim[i + 1 == rim.size() ? 0 : i + 1];
    const double along = length(next - rim[i]);
    weighted = weighted + 0.5 * along * (rim[i] + next);
    plain = plain + rim[i];
    total += along;
  }
  return total > 0 ? (1 / total) * weighted : (1 / static_cast<double>(rim.size())) * plain;
}

Surface merged(const Surface& surface) {
  formats::VertexMerger merger;
  Surface result;
  result.triangles = surface.triangles;
  for (auto& t : result.triangles)
    for (uint32_t& corner : t) corner = merger.add(surface.vertices[corner]);
  result.vertices = merger.take_places();
  return result;
}

// Returns the distance below which corners count as the two sides of a crack. It is small enough to keep short edges.
double crack_width(const Surface& surface, const std::vector<Edge>& open) {
  constexpr double of_size = 1e-4, of_edges = 0.25;
  if (open.empty()) return 0;
  std::vector<double> lengths;
  for (const auto& [from, to] : open) lengths.push_back(length(surface.vertices[to] - surface.vertices[from]));
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return std::min(of_size * length(bounds(surface).size()), of_edges * *middle);
}

// Returns for each corner of an open edge the first corner near it, and for other vertices themselves.
std::vector<uint32_t> joined_corners(const Surface& surface, const std::vector<Edge>& open) {
  std::vector<uint32_t> joined(surface.vertices.size());
  std::iota(joined.begin(), joined.end(), 0u);
  const double near = crack_width(surface, open);
  if (!(near > 0)) return joined;
  std::map<std::array<int64_t, 3>, std::vector<uint32_t>> firsts;  // by cells of width `near`
  const auto cell = [&](Vec3 p, int axis) { return static_cast<int64_t>(std::floor(p[axis] / near)); };
  const auto first_near = [&](Vec3 p) -> std::optional<uint32_t> {
    for (int64_t x = cell(p, 0) - 1; x <= cell(p, 0) + 1; ++x)
      for (int64_t y = cell(p, 1) - 1; y <= cell(p, 1) + 1; ++y)
        for (int64_t z = cell(p, 2) - 1; z <= cell(p, 2) + 1; ++z)
          if (const auto found = firsts.find({x, y, z}); found != firsts.end())
            for (const uint32_t first : found->second)
              if (length(surface.vertices[first] - p) <= near) return first;
    return std::nullopt;
  };
  std::vector<char> is_done(surface.vertices.size(), 0);
  for (const Edge& edge : open) {
    for (const uint32_t corner : edge) {
      if (is_done[corner] != 0) continue;
      is_done[corner] = 1;
      const Vec3 p = surface.vertices[corner];
      if (const auto first = first_near(p))
        joined[corner] = *first;
      else
        firsts[{cell(p, 0), cell(p, 1), cell(p, 2)}].push_back(corner);
    }
  }
  return joined;
}

class Capper {
 public:
  explicit Capper(const Surface& surface) : closed_(merged(surface)) {}

  CappedSurface close() && {
    std::vector<Edge> open = missing_edges(edges_of(closed_));
    bridge_cracks(open);
    for (const auto& loop : LoopTracer(open, closed_.vertices.size()).loops()) caps_.push_back(add_fan(loop));
    return {std::make_shared<Surface>(std::move(closed_)), std::move(caps_)};
  }

 private:
  // Adds a sliver from each open edge to the edge between the joined corners; the latter cancel out along a crack.
  void bridge_cracks(std::vector<Edge>& open) {
    const std::vector<uint32_t> joined = joined_corners(closed_, open);
    std::vector<Edge> present;
    for (const auto& [from, to] : open) {
      if (joined[from] != joined[to]) present.push_back({joined[to], joined[from]});
      if (joined[from] == from && joined[to] == to) continue;
      std::vector<uint32_t> loop{from, to};
      if (joined[to] != to) loop.push_back(joined[to]);
      if (joined[from] != from && joined[from] != loop.back()) loop.push_back(joined[from]);
      if (loop.size() > 2) add_fan(loop);
    }
    open = missing_edges(std::move(present));
  }

  Cap add_fan(const std::vector<uint32_t>& loop) {
    Cap cap;
    for (const uint32_t vertex : loop) cap.rim.push_back(closed_.vertices[vertex]);
    cap.apex = middle(cap.rim);
    const auto apex = static_cast<uint32_t>(closed_.vertices.size());
    closed_.vertices.push_back(cap.apex);
    for (size_t i = 0; i < loop.size(); ++i)
      closed_.triangles.push_back({apex, loop[i], loop[i + 1 == loop.size() ? 0 : i + 1]});
    return cap;
  }

  Surface closed_;
  std::vector<Cap> caps_;
};

}  // namespace

CappedSurface close_by_caps(const Surface& surface) { return Capper(surface).close(); }

}  // namespace ombre::importing
