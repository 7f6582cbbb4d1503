#include "surface/cells/leaf_parts.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace ombre::surface {
namespace {

// One crossing on the walk around a face, and the region before it.
struct Step {
  uint32_t crossing = 0;  // index among the crossings around the leaf
  Label before = 0;
};

class PartFinder {
 public:
  PartFinder(const CellTree& tree, const Leaf& leaf, const std::vector<Crossing>& crossings,
             std::span<const uint32_t> around)
      : tree_(tree), leaf_(leaf), crossings_(crossings), around_(around), parents_(around.size()) {
    std::iota(parents_.begin(), parents_.end(), 0U);
  }

  std::vector<uint32_t> find() {
    for (size_t axis = 0; axis < 3; ++axis)
      for (const int32_t side : {0, 1}) {
        CellPlace at = leaf_.at;
        at[axis] += side << leaf_.level;
        visit_face(at, axis, side, leaf_.level);
      }
    return numbers();
  }

 private:
  // Visits a square of the leaf's face; it is subdivided like the leaves on the other side.
  void visit_face(const CellPlace& at, size_t axis, int32_t side, int level) {
    CellPlace beyond = at;
    beyond[axis] -= 1 - side;
    const uint32_t other = tree_.find(beyond);
    if (other == CellTree::none || tree_.leaves()[other].level >= level) return join_across(at, axis, level);
    for (int32_t n = 0; n < 4; ++n) {
      CellPlace part = at;
      part[(axis + 1) % 3] += (n & 1) << (level - 1);
      part[(axis + 2) % 3] += (n >> 1) << (level - 1);
      visit_face(part, axis, side, level - 1);
    }
  }

  void join_across(const CellPlace& at, size_t axis, int level) {
    const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    CellPlace past_u = at, past_v = at;
    past_u[u] += 1 << level;
    past_v[v] += 1 << level;
    way_.clear();
    go_along(at, u, level, true);
    go_along(past_u, v, level, true);
    go_along(past_v, u, level, false);
    go_along(at, v, level, false);
    join_way();
  }

  void go_along(const CellPlace& start, size_t axis, int level, bool is_forward) {
    const size_t begin = way_.size();
    for (uint32_t n = 0; n < around_.size(); ++n)
      if (lies_on(crossings_[around_[n]].edge, start, axis, level)) {
        const CrossedEdge& edge = crossings_[around_[n]].edge;
        way_.push_back({n, is_forward ? edge.from : edge.to});
      }
    std::sort(way_.begin() + static_cast<std::ptrdiff_t>(begin), way_.end(), [&](const Step& a, const Step& b) {
      const int32_t one = crossings_[around_[a.crossing]].edge.start[axis];
      const int32_t two = crossings_[around_[b.crossing]].edge.start[axis];
      return is_forward ? one < two : one > two;
    });
  }

  static bool lies_on(const CrossedEdge& edge, const CellPlace& start, size_t axis, int level) {
    const int32_t along = edge.start[axis] - start[axis];
    return edge.axis == axis && edge.start[(axis + 1) % 3] == start[(axis + 1) % 3] &&
           edge.start[(axis + 2) % 3] == start[(axis + 2) % 3] && along >= 0 && along < 1 << level;
  }

  // Joins the crossings around one face. The region with most stretches around the face (the greatest label if several
  // have as many) stays connected across the face; what lies between two of its stretches is cut off.
  void join_way() {
    std::map<Label, size_t> stretches;
    for (const Step& step : way_) ++stretches[step.before];
    size_t most = 1;
    Label held = 0;
    for (const auto& [label, count] : stretches)
      if (count >= most) {
        most = count;
        held = label;
      }
    if (most == 1) {
      for (const Step& step : way_) join(way_[0].crossing, step.crossing);
      return;
    }
    size_t first = 0;
    while (way_[first].before != held) ++first;
    size_t last = first;
    for (size_t n = 0; n < way_.size(); ++n) {
      const size_t step = (first + n) % way_.size();
      if (way_[step].before == held)
        last = step;
      else
        join(way_[last].crossing, way_[step].crossing);
    }
  }

  void join(uint32_t a, uint32_t b) {
    a = root(a);
    b = root(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }
  uint32_t root(uint32_t n) const {
    while (parents_[n] != n) n = parents_[n];
    return n;
  }

  std::vector<uint32_t> numbers() const {
    std::vector<uint32_t> numbers(around_.size());
    uint32_t count = 0;
    for (uint32_t n = 0; n < around_.size(); ++n) numbers[n] = root(n) == n ? count++ : numbers[root(n)];
    return numbers;
  }

  const CellTree& tree_;
  const Leaf& leaf_;
  const std::vector<Crossing>& crossings_;
  std::span<const uint32_t> around_;
  std::vector<uint32_t> parents_;
  std::vector<Step> way_;
};

}  // namespace

std::vector<uint32_t> find_leaf_parts(const CellTree& tree, const Leaf& leaf, const std::vector<Crossing>& crossings,
                                      std::span<const uint32_t> around) {
  return PartFinder(tree, leaf, crossings, around).find();
}

}  // namespace ombre::surface
