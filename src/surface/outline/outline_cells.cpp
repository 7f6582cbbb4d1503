#include "surface/outline/outline_cells.h"

namespace ombre::surface {
namespace {

// The edges of a cell.
enum Edge : uint8_t { bottom, top, left, right };
constexpr size_t edges = 4;

struct SquareParts {
  std::array<uint8_t, edges> part_of_edge{};  // for crossed edges: the number of its part
  uint8_t count = 1;
};

// Labels of the corners 00, 10, 01 and 11.
using Square = std::array<Label, 4>;

std::array<bool, edges> crossed_edges(const Square& q) {
  return {q[0] != q[1], q[2] != q[3], q[0] != q[2], q[1] != q[3]};
}

SquareParts find_parts(const Square& q, const std::array<bool, edges>& crossed) {
  const bool all = crossed[bottom] && crossed[top] && crossed[left] && crossed[right];
  const bool rising = q[0] == q[3], falling = q[1] == q[2];  // both corners of a diagonal have one label
  if (!all || (!rising && !falling)) return {};
  // Corners that are not joined are cut off: 10 and 01, or 00 and 11.
  if (rising && (!falling || q[0] > q[1])) return {{0, 1, 1, 0}, 2};
  return {{0, 1, 0, 1}, 2};
}

class Tracer {
 public:
  explicit Tracer(const CornerLabels& corners) : corners_(corners), below_(static_cast<size_t>(corners.width)) {}

  OutlineGraph trace() {
    for (int32_t j = 0; j + 1 < corners_.height; ++j) trace_row(j);
    return std::move(graph_);
  }

 private:
  void trace_row(int32_t j) {
    uint32_t from_left = 0;
    for (int32_t i = 0; i + 1 < corners_.width; ++i) {
      const Square q{corners_.at(i, j), corners_.at(i + 1, j), corners_.at(i, j + 1), corners_.at(i + 1, j + 1)};
      if (q[0] == q[1] && q[0] == q[2] && q[0] == q[3]) continue;
      const auto crossed = crossed_edges(q);
      // The crossings on the lower and left edges are known from the cells below and on the left.
      std::array<uint32_t, edges> crossings{};
      if (crossed[bottom]) crossings[bottom] = below_[static_cast<size_t>(i)];
      if (crossed[left]) crossings[left] = from_left;
      if (crossed[top]) crossings[top] = below_[static_cast<size_t>(i)] = add({i, j + 1, 0, q[2], q[3], {}, {}, {}});
      if (crossed[right]) crossings[right] = from_left = add({i + 1, j, 1, q[1], q[3], {}, {}, {}});
      join(i, j, find_parts(q, crossed), crossed, crossings);
    }
  }

  uint32_t add(const OutlineCrossing& crossing) {
    graph_.crossings.push_back(crossing);
    return static_cast<uint32_t>(graph_.crossings.size() - 1);
  }

  void join(int32_t i, int32_t j, const SquareParts& parts, const std::array<bool, edges>& crossed,
            const std::array<uint32_t, edges>& crossings) {
    // The first end of an edge along x is on the left when going upwards; that of an edge along y is on the left when
    // going left.
    constexpr std::array<size_t, edges> side{1, 0, 0, 1};
    const auto first = static_cast<uint32_t>(graph_.vertices.size());
    graph_.vertices.resize(first + parts.count, {i, j, 0, {}, {}});
    for (size_t e = 0; e < edges; ++e) {
      if (!crossed[e]) continue;
      const uint32_t vertex = first + parts.part_of_edge[e];
      OutlineVertex& v = graph_.vertices[vertex];
      v.crossings[v.count++] = crossings[e];
      graph_.crossings[crossings[e]].ends[side[e]] = vertex;
    }
  }

  const CornerLabels& corners_;
  std::vector<uint32_t> below_;  // crossings of the edges along x at the bottom of this row
  OutlineGraph graph_;
};

}  // namespace

OutlineGraph trace_cells(const CornerLabels& corners) { return Tracer(corners).trace(); }

}  // namespace ombre::surface
