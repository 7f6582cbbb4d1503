// Triply periodic minimal surfaces, given by their usual trigonometric approximations.
#include <cmath>
#include <numbers>

#include "design/spec.h"
#include "program/gradient.h"

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
  const char* name;
  std::vector<Term> terms;
};

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

struct Tpms {
  Choice surface = "gyroid";
  Choice kind = "sheet";
  Numbers3 cell{10, 10, 10};
  Number thickness = 1;
  Number level = 0;
  MaterialName material;

  static Spec<Tpms> spec() {
    return {"tpms",
            "A triply periodic minimal surface, without end: cut it with an intersection.",
            {{"surface", &Tpms::surface, "Name of the surface", one_of(surface_names())},
             {"kind", &Tpms::kind, "sheet: a wall along the surface; solid: the side where the function is below level",
              one_of({"sheet", "solid"})},
             {"cell", &Tpms::cell, "Length of its period along x, y and z", unit::positive_mm},
             {"thickness", &Tpms::thickness, "Thickness of the sheet", unit::positive_mm},
             {"level", &Tpms::level, "Value of the function at the surface; 0 for the minimal surface"},
             {"material", &Tpms::material, "Its material"}},
            no_inputs,
            "intersection() { cube(20); tpms(\"gyroid\", cell=(10, 10, 10), thickness=1, material=\"red\"); }"};
  }

  Metric metric() const { return Metric::implicit(); }
  Box bounds(const Box& where) const { return where; }

  // Approximates the distance by the function divided by the length of its gradient. Near minimal surfaces this is
  // accurate to third order.
  Field distance(const Point& p) const {
    const auto [value, slope] = at(p);
    const Field from_surface = value / sqrt(slope);
    return kind == "sheet" ? abs(from_surface) - thickness(p) * 0.5 : from_surface;
  }

  Field membership(const Inputs&, const Point& p, Border border) const {
    const auto [value, slope] = at(p);
    if (kind == "solid") return at_most(value, p.constant(0), border);
    return at_most(square(value), square(thickness(p) * 0.5) * slope, border);
  }

 private:
  struct Sample {
    Field value, squared_slope;  // function minus the level, and its squared gradient in 1/mm^2
  };

  static Field phase(Field x, Field length) { return x / length * (2 * std::numbers::pi); }
  Field phase_x(const Point& p) const { return phase(p.x, cell.x(p)); }
  Field phase_y(const Point& p) const { return phase(p.y, cell.y(p)); }
  Field phase_z(const Point& p) const { return phase(p.z, cell.z(p)); }
  Field minus_level(const Point& p) const { return -level(p); }

  const Surface& chosen() const {
    for (const Surface& one : surfaces())
      if (surface == one.name) return one;
    return surfaces().front();  // the reader accepts no other name
  }

  Sample at(const Point& p) const {
    const Waves x(phase_x(p)), y(phase_y(p)), z(phase_z(p));
    Field value = minus_level(p), by_x = p.constant(0), by_y = by_x, by_z = by_x;  // derivatives by the phases
    for (const Term& term : chosen().terms) {
      const Field fx = x.value(term.x), fy = y.value(term.y), fz = z.value(term.z);
      value = value + fx * fy * fz * term.factor;
      by_x = by_x + x.slope(term.x) * fy * fz * term.factor;
      by_y = by_y + fx * y.slope(term.y) * fz * term.factor;
      by_z = by_z + fx * fy * z.slope(term.z) * term.factor;
    }
    const Gradient gx = gradient(&Tpms::phase_x, p, cell.x, 0), gy = gradient(&Tpms::phase_y, p, cell.y, 1),
                   gz = gradient(&Tpms::phase_z, p, cell.z, 2), gl = gradient(&Tpms::minus_level, p, level, -1);
    Field squared = p.constant(0);
    for (size_t n = 0; n < 3; ++n) {
      Field slope = gl[n];
      for (const auto& [by, of] : {std::pair{by_z, gz[n]}, {by_y, gy[n]}, {by_x, gx[n]}})
        if (!is_zero(of)) slope = is_zero(slope) ? by * of : by * of + slope;
      squared = squared + square(slope);
    }
    return {value, floored(squared)};
  }

  using Gradient = std::array<Field, 3>;  // per mm

  static bool is_zero(Field field) { return field.builder->constant_value(field) == 0.0; }

  // Returns the gradient of a phase along an axis, or of the level, by differences if there is no symbolic derivative.
  Gradient gradient(Field (Tpms::*of)(const Point&) const, const Point& p, const Number& number, int axis) const {
    Gradient result{p.constant(0), p.constant(0), p.constant(0)};
    if (number.constant()) {
      if (axis >= 0) result[static_cast<size_t>(axis)] = p.constant(2 * std::numbers::pi / *number.constant());
      return result;
    }
    if (const auto by_rule = program::gradient((this->*of)(p), p)) return *by_rule;
    constexpr double step = 1e-2;  // step of differences in mm
    for (int n = 0; n < 3; ++n) {
      Vec3 by;
      by[n] = step;
      const Field up = (this->*of)(p.mapped(Affine::translation(by)));
      const Field down = (this->*of)(p.mapped(Affine::translation(-by)));
      result[static_cast<size_t>(n)] = (up - down) / (2 * step);
    }
    return result;
  }

  // Keeps the quotient finite where the gradient vanishes.
  static Field floored(Field squared) { return max(squared, 1e-6); }
};

}  // namespace

void add_tpms(Registry& registry) { registry.add<Tpms>("lattices"); }

}  // namespace ombre::nodes
