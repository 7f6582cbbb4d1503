#include "nodes/common/cell_map.h"

#include "design/registry.h"

namespace ombre::nodes {

using namespace design;

Box CellMap::reach(const Box& where, double margin) const {
  if (!region.node) return where;
  if (region.node->type().is_solid()) return region.node->bounds(where, margin);
  // g of a region is the greatest distance to one of its faces. Beyond a corner of three faces at right angles the
  // distance to the region is sqrt(3) times as large. In a sector of a pipe it is up to sqrt(10) times as large: half
  // way from the axis to the inner wall, on the other side of the axis.
  constexpr double of_corners = 3.1622776601683795;
  const double reached = margin > 0 ? of_corners * margin : margin;
  return intersect(region.node->output_bounds(region.output, where.expanded(reached)).expanded(reached), where);
}

Field CellMap::cut(Field distance, const Inputs& in, const Point& p) const {
  return region.node ? max(distance, in.distance_to(region, p)) : distance;
}

Field CellMap::cut_membership(Field flag, const Inputs& in, const Point& p, Border border) const {
  if (!region.node) return flag;
  const Field inside =
      border == Border::included ? in.inside_of(region, p) : at_most(in.distance_to(region, p), 0, border);
  return logical_and(inside, flag);
}

Field squared_slope(const CellMap& map, const Slope& by, const Point& p) {
  Field sum = p.constant(0);
  if (map.is_perpendicular) {
    const Slope size = map.size_at(p);
    for (size_t n = 0; n < 3; ++n) sum = sum_without_zeros(sum, square(by[n] / size[n]));
    return sum;
  }
  const std::array<Slope, 3> slopes{map.slope_at(0, p), map.slope_at(1, p), map.slope_at(2, p)};
  for (size_t axis = 0; axis < 3; ++axis)
    sum = sum_without_zeros(sum, square(dot_without_zeros(by, {slopes[0][axis], slopes[1][axis], slopes[2][axis]})));
  return sum;
}

namespace {

// Returns the value that a number has everywhere in the box, or nothing.
std::optional<double> value_everywhere(const Number& number, const Box& where) {
  constexpr double rounding = 1e-12;
  const Interval range = number.range(where);
  const double middle = 0.5 * (range.lo + range.hi);
  const bool is_value = range.is_bounded() && range.hi - range.lo <= rounding * std::abs(middle);
  return is_value ? std::optional(middle) : std::nullopt;
}

// Returns false for places with steps, as floor(x) has, whose slopes are constant as well.
bool rises_evenly(const Number& place, int axis, const Box& where, double corner, double step) {
  constexpr double rounding = 1e-9;
  const Interval range = place.range(where);
  const double low = (where.lo[axis] - corner) / step, high = (where.hi[axis] - corner) / step;
  const double most = rounding * std::max({1.0, std::abs(low), std::abs(high)});
  return range.is_bounded() && std::abs(range.lo - low) <= most && std::abs(range.hi - high) <= most;
}

}  // namespace

std::optional<EqualBoxes> equal_boxes(const CellMap& map) {
  const Box where = map.reach(design_space(), 0);
  const Vec3 at = map.region.node ? where.lo : Vec3{};
  EqualBoxes found;
  for (int axis = 0; axis < 3; ++axis) {
    const auto part = [axis](const Numbers3& numbers) -> const Number& {
      return axis == 0 ? numbers.x : axis == 1 ? numbers.y : numbers.z;
    };
    for (int by = 0; by < 3; ++by) {
      const auto slope = value_everywhere(part(map.slopes[static_cast<size_t>(by)]), where);
      if (!slope || (by == axis ? *slope <= 0 : *slope != 0)) return std::nullopt;
      if (by == axis) found.steps[axis] = 1 / *slope;
    }
    const Interval place = part(map.place).range({at, at});
    found.corner[axis] = at[axis] - 0.5 * (place.lo + place.hi) * found.steps[axis];
    if (!rises_evenly(part(map.place), axis, where, found.corner[axis], found.steps[axis])) return std::nullopt;
  }
  return found;
}

}  // namespace ombre::nodes

namespace ombre::design {
namespace {

// Returns the number of the node's output with this name and form, or nothing.
std::optional<size_t> output_called(const Node& node, std::string_view name, OutputForm form) {
  const auto number = node.type().output(name);
  const bool fits = number && node.gives(*number) && node.type().outputs[*number].type.form == form;
  return fits ? number : std::nullopt;
}

Numbers3 vector_of(const NodePtr& node, size_t output) {
  const auto part = [&](int n) { return Number(expression_of({node, output, n})); };
  return {part(0), part(1), part(2)};
}

// Returns the node that the data gives, or its output "place".
NodePtr giver_of(const Data& data) {
  const Data* from = data.find("from");
  const Data* name = data.find("output");
  if (from && !(name && name->string() && *name->string() == "place")) return nullptr;
  const auto* object = dynamic_cast<const NodeObject*>((from ? *from : data).host_object().get());
  return object ? object->node() : nullptr;
}

}  // namespace

bool Port<nodes::CellMap>::read(const Data& data, const Domain&, nodes::CellMap& value, const Reader& reader) {
  value = {};
  if (data.is_null()) return true;
  const NodePtr node = giver_of(data);
  const auto place = node ? output_called(*node, "place", OutputForm::numbers) : std::nullopt;
  if (!place || node->type().outputs[*place].type.name != "frame")
    return reader.fail(data, "a map of cells",
                       "write for example " + spelled::call("box_cells", {{"size", "(5, 5, 5)"}}));
  reader.keep(node);
  value.from = {node.get(), *place};
  value.place = vector_of(node, *place);
  constexpr std::string_view slopes[] = {"slope_u", "slope_v", "slope_w"};
  for (size_t axis = 0; axis < 3; ++axis) value.slopes[axis] = vector_of(node, *node->type().output(slopes[axis]));
  value.size = vector_of(node, *node->type().output("size"));
  value.index = vector_of(node, *node->type().output("index"));
  const Data perpendicular = node->constant(*node->type().output("perpendicular"));
  value.is_perpendicular = perpendicular.boolean() && *perpendicular.boolean();
  if (const auto border = output_called(*node, "border", OutputForm::numbers))
    value.from_border = Number(expression_of({node, *border}));
  if (const auto region = output_called(*node, "region", OutputForm::solid)) value.region = {node.get(), *region};
  return true;
}

}  // namespace ombre::design
