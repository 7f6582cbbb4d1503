#include "studio/nodes_at.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "base/text/error.h"
#include "questions/sampler.h"

namespace ombre::studio {
namespace {

using design::Node;
using design::NodePtr;

// Greatest number of solids that are compiled and evaluated at a point; bounds exclude most others before.
constexpr size_t most_candidates = 64;

// True if the node shows the shape of its one input, as it is or in other places.
bool shows_its_input(const Node& node) {
  constexpr std::array<std::string_view, 3> elsewhere{"transforms", "warps", "arrays"};
  if (node.inputs().size() != 1) return false;
  return node.keeps_shape() || node.traits().gives_cell ||
         std::ranges::find(elsewhere, node.type().category) != elsewhere.end();
}

bool counts_last(const Node& node) {
  const int parameter = node.type().parameter("materials");
  return parameter >= 0 && node.type().get(node, static_cast<size_t>(parameter), false) == Data("last");
}

class Descent {
 public:
  Descent(const design::Design& design, Vec3 point, const StopFlag& stop)
      : design_(design), point_(point), stop_(stop) {}

  std::vector<const Node*> find() {
    std::vector<NodePtr> parts;
    for (const design::Part& part : design_.parts) parts.push_back(part.solid);
    for (NodePtr node = first_around(parts, false); node; node = input_around(*node)) path_.push_back(node.get());
    return std::move(path_);
  }

 private:
  NodePtr input_around(const Node& node) {
    if (shows_its_input(node)) {
      around_.insert(around_.begin(), &node);
      return node.inputs().front();
    }
    return node.inputs().size() < 2 ? nullptr
                                    : first_around({node.inputs().begin(), node.inputs().end()}, counts_last(node));
  }

  // Returns the solid in the place to which the nodes above move it.
  NodePtr placed(NodePtr solid) const {
    for (const Node* above : around_) solid = above->type().with_inputs(*above, {solid});
    return solid;
  }

  NodePtr first_around(std::vector<NodePtr> solids, bool is_last) const {
    if (is_last) std::ranges::reverse(solids);
    design::Design alone = design_;
    alone.parts.clear();
    std::vector<NodePtr> candidates;
    for (const NodePtr& solid : solids) {
      NodePtr there = placed(solid);
      if (there->bounds({point_, point_}).is_empty()) continue;
      if (candidates.size() == most_candidates) return nullptr;
      alone.parts.push_back({std::to_string(candidates.size()), std::move(there)});
      candidates.push_back(solid);
    }
    const size_t found = candidates.empty() ? 0 : first_inside(alone);
    return found < candidates.size() ? candidates[found] : nullptr;
  }

  // Returns the number of the first part that holds the point, or the count of parts.
  size_t first_inside(const design::Design& alone) const {
    if (stop_.requested()) throw Cancelled();
    compile::SampleQuery query;
    query.parts = true;
    Diagnostics ignored;
    const auto sampler = compile::Sampler::build(alone, query, ignored);
    if (!sampler) return alone.parts.size();
    std::vector<double> values(sampler->columns().size());
    std::vector<double*> columns;
    for (double& value : values) columns.push_back(&value);
    sampler->sample({&point_, 1}, columns, 1, &stop_);
    return static_cast<size_t>(std::ranges::find_if(values, [](double v) { return v != 0; }) - values.begin());
  }

  const design::Design& design_;
  const Vec3 point_;
  const StopFlag& stop_;
  std::vector<const Node*> path_, around_;  // around_: those that show their input, the innermost first
};

}  // namespace

std::vector<const Node*> nodes_at(const design::Design& design, Vec3 point, const StopFlag& stop) {
  return Descent(design, point, stop).find();
}

}  // namespace ombre::studio
