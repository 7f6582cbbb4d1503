// The cost of layers by height, interpolated between known ones.
#include "jobs/common/cost_profile.h"

#include <iterator>

namespace ombre::compile {
namespace {

LayerCost operator+(LayerCost a, LayerCost b) { return {a.seconds + b.seconds, a.bytes + b.bytes}; }
LayerCost operator*(double factor, LayerCost cost) { return {factor * cost.seconds, factor * cost.bytes}; }

}  // namespace

void CostProfile::add(LayerRange slab, LayerCost cost) {
  const auto begin = static_cast<double>(slab.begin), end = static_cast<double>(slab.end);
  if (end > begin) layer_costs_[(begin + end) / 2] = 1 / (end - begin) * cost;
}

LayerCost CostProfile::at(double height) const {
  if (layer_costs_.empty()) return {};
  const auto above = layer_costs_.lower_bound(height);
  if (above == layer_costs_.begin()) return above->second;
  const auto below = std::prev(above);
  if (above == layer_costs_.end()) return below->second;
  const double share = (height - below->first) / (above->first - below->first);
  return (1 - share) * below->second + share * above->second;
}

// Sums trapezoids between the slabs that are known.
LayerCost CostProfile::of(LayerRange range) const {
  const auto end = static_cast<double>(range.end);
  auto height = static_cast<double>(range.begin);
  LayerCost sum, cost = at(height);
  const auto go_to = [&](double next) {
    const LayerCost there = at(next);
    sum = sum + (next - height) / 2 * (cost + there);
    height = next;
    cost = there;
  };
  for (auto known = layer_costs_.upper_bound(height); known != layer_costs_.end() && known->first < end; ++known)
    go_to(known->first);
  if (height < end) go_to(end);
  return sum;
}

}  // namespace ombre::compile
