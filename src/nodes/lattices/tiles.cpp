// Space filled with copies of a solid.
#include <cmath>

#include "base/text/text.h"
#include "design/spec.h"
#include "nodes/common/mixtures.h"
#include "nodes/common/struts.h"

namespace ombre::nodes {
namespace {

using namespace design;

// Copies translated by integer multiples of the steps. A point is mapped into the cell around the child. There the
// child and the neighbours that reach into the cell are evaluated.
struct Tile {
  std::optional<Vec3> size, first, last;

  static Spec<Tile> spec() {
    return {
        "tile",
        "Repeats its child along x, y and z, without end unless limited: cut it with an intersection. Expressions "
        "below it may use the copy's indices ci, cj, ck.",
        {{"size", &Tile::size,
          "Distance from copy to copy; 0: no copies along that axis; none: the size of the unit cell, or of the "
          "child's box",
          unit::not_negative_mm},
         {"first", &Tile::first, "Least indices of copies, as whole numbers; the child itself is copy (0, 0, 0)", {}},
         {"last", &Tile::last, "Greatest indices of copies", {}}},
        one_solid,
        "intersection() { sphere(10); tile() { lattice(\"bcc\", (5, 5, 5), 0.4, material=\"gray\"); } }",
        {{"cell", &Tile::cell, "Indices of the copy whose cell holds the point; 0 along an axis without copies"}}};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    const Box box = inputs[0]->bounds(design_space());
    if (box.is_empty()) return reader.refuse("tile has nothing to repeat");
    const Traits traits = inputs[0]->traits_of_shape();
    const Vec3 step = size.value_or(traits.cell_size.value_or(box.size()));
    if (step == Vec3{})
      return reader.refuse(
          "tile repeats along no axis",
          "write for example " + spelled::either("tile((10, 10, 0))", "\"size\": [10, 10, 0]", "tile((10, 10, 0))"));
    double copies = 1;
    for (int n = 0; n < 3; ++n) {
      Axis& axis = axes_[static_cast<size_t>(n)];
      axis.step = step[n];
      axis.lo = box.lo[n];
      axis.hi = box.hi[n];
      if (first) axis.first = (*first)[n];
      if (last) axis.last = (*last)[n];
      if (axis.first > axis.last || !is_limit(axis.first) || !is_limit(axis.last))
        return reader.refuse("the limits of tile are whole numbers, first not above last",
                             "write for example " + spelled::parameter("first", "(0, 0, 0)") + ", " +
                                 spelled::parameter("last", "(9, 9, 0)"));
      if (axis.step == 0) continue;
      if (axis.hi - axis.lo >= design_limit_mm)
        return reader.refuse("the child of tile is unbounded along " + std::string(1, "xyz"[n]),
                             inputs[0]->uses_cell()
                                 ? "bound sizes that use ci, cj or ck, for example clamp(0.5, 1 + 0.1*ci, 2)"
                                 : "cut it to size first, or write 0 for that axis");
      axis.is_one_enough = step[n] >= traits.nearest_copy_is_enough_from[n];
      axis.middle = axis.is_one_enough ? 0 : 0.5 * (axis.lo + axis.hi);
      copies *= 2 * axis.neighbours(true) + 1;
    }
    // A small child is written out for each copy, so that parts that do not reach into the cell are removed.
    constexpr int small = 2;
    repetitions_ = inputs[0]->depth() <= small ? 1 : copies;
    constexpr double most = 343;
    if (copies <= most) return true;
    return reader.refuse(
        "what tile repeats is many times as large as its steps: " + format_number(copies) + " copies overlap",
        "give steps at least half as long as the child is");
  }

  Traits traits() const { return {.most_evaluations_of_input = repetitions_, .gives_cell = true}; }

  TileCopies all_copies() const {
    TileCopies copies;
    for (int n = 0; n < 3; ++n) {
      const Axis& axis = axes_[static_cast<size_t>(n)];
      copies.steps[n] = axis.step;
      copies.indices[static_cast<size_t>(n)] = axis.step > 0 ? Interval{axis.first, axis.last} : Interval(0);
    }
    return copies;
  }

  // Neighbours are chosen by distance, so the metric must be exact for the nearest copy to be found.
  Metric metric(const Inputs& in) const {
    const Metric metric = in.metric(0);
    if (metric.kind == Metric::Kind::exact) return Metric::bounded();
    for (const Axis& axis : axes_)
      if (axis.step > 0 && !axis.is_one_enough) return Metric::implicit();
    return metric;
  }

  Box reach(const Inputs& in, const Box& where, double margin) const {
    const Box child = in.reach(0, design_space(), margin);
    if (child.is_empty()) return child;
    Box box = where;
    for (int n = 0; n < 3; ++n) {
      const Axis& axis = axes_[static_cast<size_t>(n)];
      const double back = axis.step > 0 ? axis.step * axis.first : 0, on = axis.step > 0 ? axis.step * axis.last : 0;
      box.lo[n] = std::max(box.lo[n], child.lo[n] + back);
      box.hi[n] = std::min(box.hi[n], child.hi[n] + on);
    }
    return box;
  }

  Field distance(const Inputs& in, const Point& p) const {
    std::vector<Field> fields;
    for (const Point& q : copies(p, true, Order::any)) fields.push_back(in.distance(0, q));
    return program::fold(fields, program::min);
  }

  Field membership(const Inputs& in, const Point& p, Border border) const {
    std::vector<Field> fields;
    for (const Point& q : copies(p, false, Order::any)) fields.push_back(in.membership(0, q, border));
    return program::fold(fields, program::logical_or);
  }

  // Where copies overlap, that of the nearest cell counts. Where no copy holds the point, the one with the nearest
  // surface counts.
  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    const std::vector<Point> points = copies(p, demand == Demand::everywhere, Order::own_first);
    if (points.size() == 1) return in.composition(0, points[0], demand);
    std::vector<Composition> parts;
    for (const Point& q : points) parts.push_back(in.composition(0, q, demand));
    return weighted(parts, chosen(in, points, demand));
  }

  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand) const {
    const std::vector<Point> points = copies(p, demand == Demand::everywhere, Order::own_first);
    const std::vector<Field> weights = chosen(in, points, demand);
    Field value = in.attribute(0, name, points[0], demand);
    for (size_t n = 1; n < points.size(); ++n)
      value = select(weights[n], in.attribute(0, name, points[n], demand), value);
    return value;
  }

  Numbers4 passed(const Inputs& in, std::string_view output, const Point& p) const {
    const std::vector<Point> points = copies(p, false, Order::own_first);
    const std::vector<Field> weights = chosen(in, points, Demand::inside);
    Numbers4 value = in.output(0, output, points[0]);
    for (size_t n = 1; n < points.size(); ++n) value = select(weights[n], in.output(0, output, points[n]), value);
    return value;
  }

  VectorField cell(const Ask& ask) const {
    const std::vector<Point> points = copies(ask.p, false, Order::own_first);
    return {points[0].cell[0], points[0].cell[1], points[0].cell[2]};
  }

 private:
  enum class Order : uint8_t { own_first, any };

  static bool is_limit(double index) { return std::isinf(index) || index == std::floor(index); }

  struct Axis {
    double step = 0, lo = 0, hi = 0;  // step (0 for no copies), and extent of the child
    double middle = 0;                // centre of the cell that contains the child
    bool is_one_enough = false;
    double first = -Box::inf, last = Box::inf;  // least and greatest index

    bool is_limited() const { return std::isfinite(first) || std::isfinite(last); }

    // Returns the number of copies on each side that matter in a cell: those that reach into it, or, if `nearest`,
    // those that may be nearest. Returns 0 if no neighbour is ever nearer than the own copy.
    int neighbours(bool nearest) const {
      if (step == 0 || is_one_enough) return 0;
      constexpr double rounding = 1e-9;
      const double half = std::max(hi - middle, middle - lo) / step;
      return static_cast<int>(std::floor((nearest ? 1 : 0.5) + half + rounding));
    }

    struct Copy {
      Field index, at;  // number of the copy, and position within it
      Interval extent;  // range of `at`
    };
    std::vector<Copy> copies(Field x, bool nearest, Order order) const {
      const int most = neighbours(nearest);
      std::vector<Copy> result;
      if (order == Order::any && step > 0 && last - first <= 2 * most) {  // there are no more copies than neighbours
        for (double index = first; index <= last; ++index)
          result.push_back({x.builder->constant(index), x - index * step, Interval::everything()});
        return result;
      }
      result.push_back(copy(x, 0));
      for (int away = 1; away <= most; ++away)
        for (const int offset : {-away, away}) result.push_back(copy(x, offset));
      return result;
    }
    Copy copy(Field x, int offset) const {
      program::Builder& builder = *x.builder;
      if (step == 0) return {builder.constant(0), x, Interval::everything()};
      Field own = builder.apply(program::Op::round, (x - middle) / step);
      if (is_limited()) own = clamped(own + offset);
      const Field index = is_limited() ? own : own + offset;
      const Field at = x - index * step;
      if (is_limited() || offset != 0) return {index, at, extent(offset)};
      // The clamp tells intervals a bound that they cannot derive.
      return {index, min(max(at, middle - 0.5 * step), builder.constant(middle + 0.5 * step)), extent(0)};
    }
    Field clamped(Field index) const {
      if (std::isfinite(first)) index = max(index, first);
      return std::isfinite(last) ? min(index, index.builder->constant(last)) : index;
    }

    Interval extent(int offset) const {
      if (step == 0 || is_limited()) return Interval::everything();
      const double rounding = 1e-6 * step, at = middle - offset * step;
      return {at - 0.5 * step - rounding, at + 0.5 * step + rounding};
    }
  };

  // Returns the point in the coordinates of each copy that matters.
  std::vector<Point> copies(const Point& p, bool nearest, Order order) const {
    std::vector<Point> points;
    const auto along_x = axes_[0].copies(p.x, nearest, order), along_y = axes_[1].copies(p.y, nearest, order),
               along_z = axes_[2].copies(p.z, nearest, order);
    for (const Axis::Copy& z : along_z)
      for (const Axis::Copy& y : along_y)
        for (const Axis::Copy& x : along_x) {
          Point q = p.moved_to(x.at, y.at, z.at);
          q.cell = {x.index, y.index, z.index};
          q.set_within({{x.extent.lo, y.extent.lo, z.extent.lo}, {x.extent.hi, y.extent.hi, z.extent.hi}});
          points.push_back(q);
        }
    return points;
  }

  static std::vector<Field> flags(const Inputs& in, const std::vector<Point>& points) {
    std::vector<Field> fields;
    for (const Point& q : points) fields.push_back(in.inside(0, q));
    return fields;
  }

  static std::vector<Field> chosen(const Inputs& in, const std::vector<Point>& points, Demand demand) {
    std::vector<Field> result = flags(in, points);
    if (demand == Demand::everywhere) {
      std::vector<Field> distances;
      for (const Point& q : points) distances.push_back(in.distance(0, q));
      const Field none = logical_not(program::fold(result, program::logical_or));
      const std::vector<Field> close = nodes::nearest(distances);
      for (size_t n = 0; n < result.size(); ++n) result[n] = logical_or(result[n], logical_and(none, close[n]));
    }
    return first_true(result);
  }

  std::array<Axis, 3> axes_;
  double repetitions_ = 1;
};

}  // namespace

std::optional<TileCopies> tile_copies_of(const design::Node& node) {
  const auto* tile = dynamic_cast<const NodeOf<Tile>*>(&node);
  return tile ? std::optional(tile->data.all_copies()) : std::nullopt;
}

void add_tiles(Registry& registry) { registry.add<Tile>("lattices"); }

}  // namespace ombre::nodes
