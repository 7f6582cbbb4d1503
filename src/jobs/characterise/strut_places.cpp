#include "jobs/characterise/strut_places.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "design/registry.h"
#include "jobs/mesh/strut_frames.h"
#include "nodes/common/struts.h"

namespace ombre::compile {
namespace {

using design::Node;

enum class Effect : uint8_t { none, on_thickness, on_lengths };

// Returns what a node without an InputFrame may do to the struts of its inputs.
Effect effect_of(const Node& node) {
  constexpr std::array keeps{"negate",       "solid_of",   "array_linear", "array_grid", "array_polar",
                             "array_mirror", "keep_parts", "fill_holes",   "redistance"};
  constexpr std::array thickens{"offset", "shell", "dilate", "erode", "opening", "closing"};
  if (std::ranges::find(keeps, node.type().name) != keeps.end()) return Effect::none;
  return std::ranges::find(thickens, node.type().name) != thickens.end() ? Effect::on_thickness : Effect::on_lengths;
}

Affine without_offset(Affine map) {
  map.offset = {};
  return map;
}

// Returns the steps of a tile along axes with more than one copy.
Vec3 steps_of(const nodes::TileCopies& copies) {
  Vec3 steps;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval& indices = copies.indices[static_cast<size_t>(axis)];
    if (indices.hi > indices.lo) steps[axis] = copies.steps[axis];
  }
  return steps;
}

// Numbers of a map, rounded to nine digits. They are equal for places that differ by a motion alone.
class PlaceKey {
 public:
  explicit PlaceKey(const StrutPlace& place) {
    std::array<Vec3, 3> edges;  // what the map makes of the unit vectors
    for (int axis = 0; axis < 3; ++axis) edges[static_cast<size_t>(axis)] = image_of_axis(place.mm_from_cell, axis);
    double trace = 0;
    for (const Vec3& edge : edges) trace += dot(edge, edge);
    add(std::log(trace));
    for (size_t i = 0; i < 3; ++i)
      for (size_t j = 0; j <= i; ++j) add(dot(edges[i], edges[j]) / trace);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 edge = image_of_axis(place.cell_from_node, axis);
      add(std::log(length(edge)));
      for (int other = 0; other < 3; ++other) add(edge[other] / length(edge));
      add(std::log1p(place.steps[axis]));
    }
    texts_ = {place.lengths_may_change, place.thickness_may_change};
  }
  auto operator<=>(const PlaceKey&) const = default;  // NOLINT(modernize-use-nullptr): clang 14 finds one in it

 private:
  static Vec3 image_of_axis(const Affine& map, int axis) {
    Vec3 unit;
    unit[axis] = 1;
    return map.linear(unit);
  }
  // The odd offset keeps usual numbers away from the steps of rounding.
  void add(double number) { numbers_.push_back(std::llround(number * 1e9 + 0.3819660112501051)); }

  std::vector<int64_t> numbers_;
  std::array<std::string, 2> texts_;
};

class PlaceSearch {
 public:
  explicit PlaceSearch(const design::Design& design) {
    const std::vector<const Node*> all = design::topological(design.roots());
    for (const Node* node : all) {
      const auto has_struts = [&](const design::NodePtr& below) { return with_struts_.contains(below.get()); };
      if (nodes::makes_struts(*node) || std::ranges::any_of(node->dependencies(), has_struts))
        with_struts_.insert({node, {}});
    }
    for (const design::NodePtr& root : design.roots()) visit(*root, {});
    for (const Node* node : all)
      if (const auto found = places_.find(node); found != places_.end())
        std::ranges::copy(found->second, std::back_inserter(in_order_));
  }

  std::vector<StrutPlace> in_order() { return std::move(in_order_); }

 private:
  static constexpr size_t most_places = 100;  // of a node

  void visit(const Node& node, StrutPlace here) {
    const auto known = with_struts_.find(&node);
    if (known == with_struts_.end()) return;
    if (known->second.size() >= most_places) {
      here = {};
      here.lengths_may_change = "they are used in more than a hundred ways";
    }
    if (!known->second.insert(PlaceKey(here)).second) return;
    if (nodes::makes_struts(node)) {
      here.node = &node;
      places_[&node].push_back(here);
    }
    for (const design::NodePtr& input : node.inputs()) visit(*input, below(node, here));
    for (const design::NodePtr& value : node.values()) visit(*value, changed(node, here));
  }

  static StrutPlace below(const Node& node, StrutPlace place) {
    const auto frame = input_frame(node);
    if (!frame) return changed(node, std::move(place));
    if (frame->copies) return in_tile(*frame->copies, place);
    Affine& map = place.steps == Vec3{} ? place.mm_from_cell : place.cell_from_node;
    map = map * without_offset(frame->here_from_input);
    return place;
  }

  // A tile along other axes than the tile above makes one with both. Else the inner one decides.
  static StrutPlace in_tile(const nodes::TileCopies& copies, StrutPlace place) {
    const Vec3 steps = steps_of(copies);
    if (steps == Vec3{}) return place;
    bool is_along_others = place.cell_from_node.is_identity();
    for (int axis = 0; axis < 3; ++axis)
      is_along_others = is_along_others && (steps[axis] == 0 || place.steps[axis] == 0);
    if (is_along_others) {
      place.steps = place.steps + steps;
      return place;
    }
    place.mm_from_cell = place.mm_from_cell * place.cell_from_node;
    place.cell_from_node = {};
    place.steps = steps;
    return place;
  }

  static StrutPlace changed(const Node& node, StrutPlace place) {
    const Effect effect = effect_of(node);
    if (effect == Effect::none) return place;
    std::string& reason = effect == Effect::on_lengths ? place.lengths_may_change : place.thickness_may_change;
    if (reason.empty()) reason = '"' + node.type().name + "\" may change them";
    return place;
  }

  std::unordered_map<const Node*, std::set<PlaceKey>> with_struts_;  // and the places that were visited
  std::unordered_map<const Node*, std::vector<StrutPlace>> places_;
  std::vector<StrutPlace> in_order_;
};

}  // namespace

std::vector<StrutPlace> strut_places(const design::Design& design) { return PlaceSearch(design).in_order(); }

}  // namespace ombre::compile
