// Triply periodic minimal surfaces, given by their usual trigonometric approximations.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/math/math.h"
#include "base/text/text.h"
#include "design/spec.h"
#include "nodes/common/cell_map.h"

namespace ombre::nodes {
namespace {

// Lengths of the period along x, y and z, if they are given.
struct Period {
  std::optional<design::Numbers3> along;
};

}  // namespace
}  // namespace ombre::nodes

namespace ombre::design {

template <>
struct Port<nodes::Period> {
  static PortText text(const Domain& domain) { return Port<Numbers3>::text(domain); }
  static bool read(const Data& data, const Domain& domain, nodes::Period& value, const Reader& reader) {
    return design::read(data, domain, value.along, reader);
  }
  static Data write(const nodes::Period& value, bool for_hash) { return design::write(value.along, for_hash); }
  static bool is_constant(const nodes::Period& value) { return !value.along || design::is_constant(*value.along); }
  static bool uses_cell(const nodes::Period& value) { return value.along && design::uses_cell(*value.along); }
};

}  // namespace ombre::design

namespace ombre::nodes {
namespace {

using namespace design;

// A factor of a term: 1, or the sine or cosine of a multiple of the phase along one axis.
enum class Wave : uint8_t { one, sin, cos, sin2, cos2 };

struct Term {
  double factor;
  Wave x, y, z;
};

struct Surface {
  // The function at a point, and its derivatives by the phases.
  struct Sample {
    double value;
    std::array<double, 3> by;
  };

  const char* name;
  std::vector<Term> terms;

  // Returns samples at points of a cell, of which there are so many along each axis.
  std::vector<Sample> samples(const std::array<size_t, 3>& counts) const;
};

// Returns the value of a wave at a phase, and its derivative.
std::array<double, 2> value_and_slope(Wave wave, double phase) {
  const double s = math::sin(phase), c = math::cos(phase);
  switch (wave) {
    case Wave::one:
      return {1, 0};
    case Wave::sin:
      return {s, c};
    case Wave::cos:
      return {c, -s};
    case Wave::sin2:
      return {2 * s * c, 2 - 4 * s * s};
    case Wave::cos2:
      return {1 - 2 * s * s, -4 * s * c};
  }
  return {1, 0};
}

std::vector<Surface::Sample> Surface::samples(const std::array<size_t, 3>& counts) const {
  constexpr std::array<double, 3> off{0.31, 0.43, 0.57};  // parts of a step, different along each axis
  constexpr size_t waves = 5;
  std::array<std::vector<std::array<std::array<double, 2>, waves>>, 3> table;
  for (size_t axis = 0; axis < 3; ++axis) {
    table[axis].resize(counts[axis]);
    for (size_t n = 0; n < counts[axis]; ++n)
      for (size_t wave = 0; wave < waves; ++wave)
        table[axis][n][wave] =
            value_and_slope(static_cast<Wave>(wave), 2 * std::numbers::pi * (static_cast<double>(n) + off[axis]) /
                                                         static_cast<double>(counts[axis]));
  }
  std::vector<Sample> all;
  all.reserve(counts[0] * counts[1] * counts[2]);
  for (size_t k = 0; k < counts[2]; ++k)
    for (size_t j = 0; j < counts[1]; ++j)
      for (size_t i = 0; i < counts[0]; ++i) {
        Sample sample{};
        for (const Term& term : terms) {
          const auto& x = table[0][i][static_cast<size_t>(term.x)];
          const auto& y = table[1][j][static_cast<size_t>(term.y)];
          const auto& z = table[2][k][static_cast<size_t>(term.z)];
          sample.value += term.factor * x[0] * y[0] * z[0];
          sample.by[0] += term.factor * x[1] * y[0] * z[0];
          sample.by[1] += term.factor * x[0] * y[1] * z[0];
          sample.by[2] += term.factor * x[0] * y[0] * z[1];
        }
        all.push_back(sample);
      }
  return all;
}

// Returns the terms and those that result from cyclic permutation of the axes.
std::vector<Term> cyclic(std::initializer_list<Term> some) {
  std::vector<Term> all;
  for (const auto& [factor, x, y, z] : some) {
    all.push_back({factor, x, y, z});
    if (x == y && y == z) continue;
    all.push_back({factor, z, x, y});
    all.push_back({factor, y, z, x});
  }
  return all;
}

const std::vector<Surface>& surfaces() {
  using enum Wave;
  static const std::vector<Surface> all{
      {"gyroid", cyclic({{1, sin, cos, one}})},
      {"schwarz_p", cyclic({{1, cos, one, one}})},
      {"schwarz_d", cyclic({{1, sin, sin, sin}, {1, sin, cos, cos}})},
      {"neovius", cyclic({{3, cos, one, one}, {4, cos, cos, cos}})},
      {"lidinoid", cyclic({{0.5, sin2, cos, sin}, {-0.5, cos2, cos2, one}, {0.15, one, one, one}})},
      {"iwp", cyclic({{2, cos, cos, one}, {-1, cos2, one, one}})},
      {"split_p", cyclic({{1.1, sin2, cos, sin}, {-0.2, cos2, cos2, one}, {-0.4, cos2, one, one}})},
  };
  return all;
}

std::vector<std::string> surface_names() {
  std::vector<std::string> names;
  for (const Surface& surface : surfaces()) names.emplace_back(surface.name);
  return names;
}

// The sines and cosines of one phase, and their derivatives by it.
struct Waves {
  Field sin, cos, sin2, cos2, one, zero;

  explicit Waves(Field phase) {
    program::Builder& builder = *phase.builder;
    sin = builder.apply(program::Op::sin, phase);
    cos = builder.apply(program::Op::cos, phase);
    sin2 = sin * cos * 2.0;
    cos2 = 1 - square(sin) * 2.0;
    one = builder.constant(1);
    zero = builder.constant(0);
  }

  Field value(Wave wave) const {
    return wave == Wave::one    ? one
           : wave == Wave::sin  ? sin
           : wave == Wave::cos  ? cos
           : wave == Wave::sin2 ? sin2
                                : cos2;
  }
  Field slope(Wave wave) const {
    switch (wave) {
      case Wave::one:
        return zero;
      case Wave::sin:
        return cos;
      case Wave::cos:
        return -sin;
      case Wave::sin2:
        return cos2 * 2.0;
      case Wave::cos2:
        return sin2 * -2.0;
    }
    return zero;
  }
};

const Surface& surface_called(const Choice& name) {
  for (const Surface& one : surfaces())
    if (name == one.name) return one;
  return surfaces().front();  // the reader accepts no other name
}

constexpr double turn = 2 * std::numbers::pi;

// The function of a surface at a place among cells, as a value that formulas mix and change.
struct TpmsValue {
  Choice surface = "gyroid";
  CellMap map;

  static Spec<TpmsValue> spec() {
    return {
        "tpms_value",
        "The function of a triply periodic minimal surface in the cells of a map: 0 on the surface, with one sign on "
        "each side. Formulas mix such values before tpms makes walls of them.",
        {{"surface", &TpmsValue::surface, "Name of the surface", one_of(surface_names())},
         {"map", &TpmsValue::map, "A map of cells, such as box_cells", required()}},
        no_inputs,
        "m = box_cells((6, 6, 6), min=(0, 0, 0), max=(24, 12, 6)); t = m.place.x/4; tpms(map=m, thickness=0.5, "
        "material=\"red\", equation=(1 - t)*tpms_value(\"gyroid\", m) + t*tpms_value(\"schwarz_p\", m));",
        {{"value", &TpmsValue::value, "Value of the function, which has no unit"}}};
  }

  Field value(const Ask& ask) const {
    const Slope at = map.place_at(ask.p);
    const Waves x(at[0] * turn), y(at[1] * turn), z(at[2] * turn);
    Field sum = ask.p.constant(0);
    for (const Term& term : surface_called(surface).terms)
      sum = sum + x.value(term.x) * y.value(term.y) * z.value(term.z) * term.factor;
    return sum;
  }
};

struct Tpms {
  Choice surface = "gyroid";
  Choice kind = "sheet";
  Period cell;
  Number thickness = 1;
  Number level = 0;
  MaterialName material;
  CellMap map;
  std::optional<double> density;
  std::optional<Number> equation;

  static Spec<Tpms> spec() {
    return {
        "tpms",
        "A triply periodic minimal surface. Without a map it has no end: cut it with an intersection.",
        {{"surface", &Tpms::surface, "Name of the surface", one_of(surface_names())},
         {"kind", &Tpms::kind, "sheet: a wall along the surface; solid: the side where the function is below level",
          one_of({"sheet", "solid"})},
         {"cell", &Tpms::cell, "Length of its period along x, y and z; none: 10 mm, or with a map one cell",
          unit::positive_mm},
         {"thickness", &Tpms::thickness, "Thickness of the sheet", unit::positive_mm},
         {"level", &Tpms::level, "Value of the function at the surface; 0 for the minimal surface"},
         {"material", &Tpms::material, "Its material"},
         {"density", &Tpms::density,
          "Share of a cell that is filled; it takes the place of the level of a solid, or of the thickness of a sheet "
          "in cells of constant size",
          from_to(0.01, 0.99)},
         {"map", &Tpms::map, "A map of cells, such as cylinder_cells, whose region it fills; none: x, y and z"},
         {"equation", &Tpms::equation,
          "A formula in place of the surface's function. In it u, v and w are the place among cells; its period along "
          "each is 1",
          with_variables({"u", "v", "w"})}},
        no_inputs,
        "intersection() { cube(20); tpms(\"gyroid\", cell=(10, 10, 10), thickness=1, material=\"red\"); }"};
  }

  bool complete(const Reader& reader) {
    if (map.is_given() && cell.along)
      return reader.refuse("tpms has both a map and the size of its cells",
                           "leave out cell: the map says how large cells are");
    if (equation) warn_if_not_periodic(reader);
    if (!density) return true;
    if (equation)
      return reader.refuse("the density of a formula's surface is not known",
                           "write " + std::string(kind == "sheet" ? "the thickness" : "the level") +
                               ", and measure the density with ombre characterise");
    if (kind == "solid") {
      level = value_below_which(*density, {});
      return true;
    }
    const std::optional<Vec3> lengths = constant_lengths();
    if (!lengths || !level.constant())
      return reader.refuse("the density of a sheet needs cells that are equal boxes, and a constant level",
                           "write the thickness, or " + spelled::parameter("kind", "\"solid\""));
    thickness = value_below_which(*density, *lengths);
    return true;
  }

  Metric metric() const { return Metric::implicit(); }
  Box reach(const Inputs&, const Box& where, double margin) const { return map.reach(where, margin); }

  // Approximates the distance by the function divided by the length of its gradient. Near minimal surfaces this is
  // accurate to third order.
  Field distance(const Inputs& in, const Point& p) const {
    const auto [value, slope] = at(p);
    const Field from_surface = value / sqrt(slope);
    return map.cut(kind == "sheet" ? abs(from_surface) - thickness(p) * 0.5 : from_surface, in, p);
  }

  Field membership(const Inputs& in, const Point& p, Border border) const {
    const auto [value, slope] = at(p);
    const Field flag = kind == "solid" ? at_most(value, p.constant(0), border)
                                       : at_most(square(value), signed_square(thickness(p) * 0.5) * slope, border);
    return map.cut_membership(flag, in, p, border);
  }

 private:
  struct Sample {
    Field value, squared_slope;  // function minus the level, and its squared gradient in 1/mm^2
  };

  // The place u, v and w among cells.
  Slope place(const Point& p) const {
    if (map.is_given()) return map.place_at(p);
    return {p.x / period(0)(p), p.y / period(1)(p), p.z / period(2)(p)};
  }
  // The phases along the axes of the cell.
  std::array<Field, 3> phases(const Point& p) const {
    const Slope at = place(p);
    return {at[0] * turn, at[1] * turn, at[2] * turn};
  }
  Number period(int axis) const {
    if (!cell.along) return 10;
    return axis == 0 ? cell.along->x : axis == 1 ? cell.along->y : cell.along->z;
  }

  // Returns the lengths of cells that are equal boxes.
  std::optional<Vec3> constant_lengths() const {
    if (map.is_given()) {
      const auto boxes = equal_boxes(map);
      return boxes ? std::optional(boxes->steps) : std::nullopt;
    }
    if (cell.along && !design::is_constant(*cell.along)) return std::nullopt;
    return Vec3{*period(0).constant(), *period(1).constant(), *period(2).constant()};
  }

  // Returns the level, or the thickness of a sheet in cells of these lengths, for which this share of a cell is filled.
  // Points of a lattice sample the function. Its numbers of points have no common divisor, and it is moved off the
  // planes of symmetry, so that no two points are alike by the symmetry of the surface. The error of the share is less
  // than 1e-3.
  double value_below_which(double share, Vec3 lengths) const {
    const std::vector<Surface::Sample> samples = chosen().samples({97, 101, 103});
    std::vector<double> values;
    values.reserve(samples.size());
    for (const auto& [value, by] : samples) {
      double squared = 0;
      for (size_t n = 0; n < 3 && kind == "sheet"; ++n) {
        const double slope = by[n] * turn / lengths[static_cast<int>(n)];
        squared += slope * slope;
      }
      values.push_back(kind == "sheet" ? 2 * std::abs(value - *level.constant()) / std::sqrt(squared) : value);
    }
    const auto at = values.begin() + static_cast<ptrdiff_t>(share * static_cast<double>(values.size()));
    std::ranges::nth_element(values, at);
    return *at;
  }

  const Surface& chosen() const { return surface_called(surface); }

  // Returns the number of the equation at a place, if it depends on nothing but u, v and w.
  std::optional<double> value_of_equation(Vec3 at) const {
    program::Builder builder;
    const auto constant = [&](double value) { return builder.constant(value); };
    const Point p = Point::origin_frame(builder).moved_to(constant(at.x), constant(at.y), constant(at.z));
    return builder.constant_value(function_value(p, {constant(at.x), constant(at.y), constant(at.z)}));
  }

  // Returns the numbers of cells of the region along u, v and w; infinity without a region.
  Vec3 counts_of_cells() const {
    if (!map.region.node) return {Box::inf, Box::inf, Box::inf};
    const Box box = map.reach(design_space(), 0);
    const auto of = [&](const Number& index) {
      const Interval range = index.range(box);
      return range.hi - range.lo + 1;
    };
    return {of(map.index.x), of(map.index.y), of(map.index.z)};
  }

  // Walls of an equation meet at the borders of cells if its period is 1. The walls of a sheet also do if its sign
  // changes. Equations that depend on space in other ways change from cell to cell on purpose.
  void warn_if_not_periodic(const Reader& reader) const {
    const expr::Expression* formula = equation->expression();
    if (!formula || !formula->inputs().empty() || !level.constant()) return;
    if (std::ranges::any_of(expr::coordinate_names(), [&](const std::string& name) { return formula->uses(name); }))
      return;
    constexpr double tolerance = 1e-6, one_cell = 1.5;
    constexpr std::array places{Vec3{0.137, 0.411, 0.773}, Vec3{0.619, 0.283, 0.057}, Vec3{0.871, 0.937, 0.349}};
    const Vec3 cells = counts_of_cells();
    for (int axis = 0; axis < 3; ++axis) {
      if (cells[axis] <= one_cell) continue;
      for (const Vec3 place : places) {
        Vec3 next = place;
        next[axis] += 1;
        const auto here = value_of_equation(place), there = value_of_equation(next);
        if (!here || !there || std::isnan(*here) || std::isnan(*there)) return;
        const double allowed = tolerance * (1 + std::abs(*here));
        if (std::abs(*here - *there) <= allowed) continue;
        if (kind == "sheet" && *level.constant() == 0 && std::abs(*here + *there) <= allowed) continue;
        const std::string name(1, "uvw"[axis]);
        reader.diagnostics.warning(Code::parameters, reader.where,
                                   "the equation of tpms is " + format_rounded(*here, 4) + " at a place, and " +
                                       format_rounded(*there, 4) + " one cell farther along " + name +
                                       ": walls of neighbouring cells may not meet",
                                   "write functions of period 1, for example sin(2*pi*" + name +
                                       "); changes from cell to cell may use x, y, z "
                                       "or values of the map");
        return;
      }
    }
  }

  Field function_value(const Point& p, const Slope& at) const {
    const expr::Variables variables = [&](std::string_view name) -> std::optional<Field> {
      return name == "u"   ? std::optional(at[0])
             : name == "v" ? std::optional(at[1])
             : name == "w" ? std::optional(at[2])
                           : std::nullopt;
    };
    return equation->at(p, variables) - level(p);
  }

  // Uses the slopes of the map if the formula depends on space through u, v and w alone.
  Sample at_function(const Point& p) const {
    const Slope at = place(p);
    const Field value = function_value(p, at);
    const auto by = map.is_given() ? program::gradient(value, Point::of(at[0], at[1], at[2])) : std::nullopt;
    if (by) return {value, floored(nodes::squared_slope(map, *by, p))};
    const Slope slope = slope_at([&](const Point& q) { return function_value(q, place(q)); }, p);
    return {value, floored(dot_without_zeros(slope, slope))};
  }

  Sample at(const Point& p) const {
    if (equation) return at_function(p);
    const auto phase_at = phases(p);
    const Waves x(phase_at[0]), y(phase_at[1]), z(phase_at[2]);
    Field value = -level(p), by_x = p.constant(0), by_y = by_x, by_z = by_x;  // derivatives by the phases
    for (const Term& term : chosen().terms) {
      const Field fx = x.value(term.x), fy = y.value(term.y), fz = z.value(term.z);
      value = value + fx * fy * fz * term.factor;
      by_x = by_x + x.slope(term.x) * fy * fz * term.factor;
      by_y = by_y + fx * y.slope(term.y) * fz * term.factor;
      by_z = by_z + fx * fy * z.slope(term.z) * term.factor;
    }
    return {value, floored(squared_slope({by_x, by_y, by_z}, p))};
  }

  // Returns the square of the function's gradient, given its derivatives by the phases.
  Field squared_slope(const Slope& by, const Point& p) const {
    if (map.is_given() && level.constant())
      return nodes::squared_slope(map, {by[0] * turn, by[1] * turn, by[2] * turn}, p);
    const std::array<Slope, 3> of{phase_slope(p, 0), phase_slope(p, 1), phase_slope(p, 2)};
    const Slope of_level = level.constant() ? Slope{p.constant(0), p.constant(0), p.constant(0)}
                                            : slope_at([&](const Point& q) { return -level(q); }, p);
    Field squared = p.constant(0);
    for (size_t axis = 0; axis < 3; ++axis) {
      Field slope = of_level[axis];
      for (const size_t n : {size_t{2}, size_t{1}, size_t{0}})
        slope = sum_without_zeros(product_without_zeros(by[n], of[n][axis]), slope);
      squared = squared + square(slope);
    }
    return squared;
  }

  Slope phase_slope(const Point& p, size_t axis) const {
    if (map.is_given()) {
      const Slope slope = map.slope_at(axis, p);
      return {slope[0] * turn, slope[1] * turn, slope[2] * turn};
    }
    const Number length = period(static_cast<int>(axis));
    if (!length.constant()) return slope_at([&](const Point& q) { return phases(q)[axis]; }, p);
    Slope result{p.constant(0), p.constant(0), p.constant(0)};
    result[axis] = p.constant(turn / *length.constant());
    return result;
  }

  // Keeps the quotient finite where the gradient vanishes.
  static Field floored(Field squared) { return max(squared, 1e-6); }
};

}  // namespace

void add_tpms(Registry& registry) { registry.add<Tpms>("lattices"); }
void add_tpms_values(Registry& registry) { registry.add<TpmsValue>("cells"); }

}  // namespace ombre::nodes
