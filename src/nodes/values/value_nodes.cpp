// Values computed from other values, and from the position in a lattice of cells.
#include <cmath>
#include <map>

#include "design/spec.h"

namespace ombre::nodes {
namespace {

using namespace design;
using program::Op;

struct Formula {
  Number expression;

  static Spec<Formula> spec() {
    return {"formula",
            "The value of an expression, which can then be used in others.",
            {{"expression", &Formula::expression, "A number, or an expression in quotes", required()}},
            no_inputs,
            "sphere(8 + 2*formula(\"sin(5*theta)\"));",
            {{"value", &Formula::value, "The expression's value"}}};
  }

  Field value(const Ask& ask) const { return expression(ask.p); }
};

struct Mix {
  NumberOrMaterial a, b;
  Number t = 0.5;

  static Spec<Mix> spec() {
    return {
        "mix",
        "A mean of two numbers, or a mixture of two materials or mixtures, with the share t of the second and 1 - t of "
        "the first.",
        {{"a", &Mix::a, "Result where t is 0 or less", required()},
         {"b", &Mix::b, "Result where t is 1 or more", required()},
         {"t", &Mix::t, "Share of b"}},
        no_inputs,
        "sphere(8, mix(\"red\", \"blue\", noise(size=4)));",
        {{"value", &Mix::value, "Number between two numbers"}, {"mixture", &Mix::mixture, "Mixture of two materials"}}};
  }

  bool complete(const Reader& reader) const {
    if (a.material.is_given() == b.material.is_given()) return true;
    return reader.refuse("mix is given a number and a material", "give two of the same kind");
  }

  bool gives(size_t output) const { return output == (a.material.is_given() ? 1 : 0); }

  Field value(const Ask& ask) const {
    const Field share = min(max(t(ask.p), 0.0), ask.p.constant(1));
    return a.number(ask.p) * (1.0 - share) + b.number(ask.p) * share;
  }

  Composition mixture(const Ask& ask) const {
    const Field raw = t(ask.p), zero = ask.p.constant(0), usable = is_finite(raw);
    const Field share = select(usable, min(max(raw, 0.0), ask.p.constant(1)), zero);
    const Composition first = ask.in.composition_of(a.material, ask.p),
                      second = ask.in.composition_of(b.material, ask.p);
    std::map<MaterialId, Field> fractions;
    for (const auto& [id, fraction] : first.fractions) fractions[id] = fraction * (1.0 - share);
    for (const auto& [id, fraction] : second.fractions) {
      Field& sum = fractions[id];
      sum = sum ? sum + fraction * share : fraction * share;
    }
    Composition result{{fractions.begin(), fractions.end()}, first.checks};
    result.checks.insert(result.checks.end(), second.checks.begin(), second.checks.end());
    if (ask.p.builder().constant_value(usable) != 1.0)
      result.checks.push_back(
          ask.in.check(logical_not(usable), "the share t of mix is not a finite number, only a is taken there"));
    return result;
  }
};

struct Cells {
  Vec3 size{10, 10, 10};

  static Spec<Cells> spec() {
    return {
        "cells",
        "The position of a point in a lattice of boxes, one of which is centred on the origin. They are the cells of "
        "tile with the same size.",
        {{"size", &Cells::size, "Size of a cell; 0: a single unbounded cell along that axis", unit::not_negative_mm}},
        no_inputs,
        "intersection() { sphere(10); tile((4, 4, 4)) { sphere(2.5, mix(\"red\", \"blue\", "
        "cells((4, 4, 4)).distance)); } }",
        {{"index", &Cells::index,
          "Index of the cell along x, y and z, as whole numbers; the cell at the origin is 0, 0, 0"},
         {"local", &Cells::local, "Position in the cell, from -0.5 to 0.5 along x, y and z"},
         {"distance", &Cells::distance, "Distance to the nearest border of the cell, mm"}}};
  }

  bool complete(const Reader& reader) const {
    if (size != Vec3{}) return true;
    return reader.refuse("cells has no borders along any axis",
                         "write for example " + spelled::either("cells((10, 10, 10))", "\"size\": [10, 10, 10]",
                                                                "ombre.cells((10, 10, 10))"));
  }

  VectorField index(const Ask& ask) const {
    return {index_along(ask.p, 0), index_along(ask.p, 1), index_along(ask.p, 2)};
  }
  VectorField local(const Ask& ask) const {
    return {local_along(ask.p, 0), local_along(ask.p, 1), local_along(ask.p, 2)};
  }

  Field distance(const Ask& ask) const {
    std::vector<Field> borders;
    for (int axis = 0; axis < 3; ++axis)
      if (size[axis] > 0) borders.push_back((0.5 - abs(local_along(ask.p, axis))) * size[axis]);
    return program::fold(borders, program::min);
  }

 private:
  static Field coordinate(const Point& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

  Field index_along(const Point& p, int axis) const {
    if (size[axis] == 0) return p.constant(0);
    return p.builder().apply(Op::floor, coordinate(p, axis) / size[axis] + 0.5);
  }

  Field local_along(const Point& p, int axis) const {
    if (size[axis] == 0) return p.constant(0);
    // The clamp changes only rounding errors; it tells intervals a bound that they cannot derive.
    return min(max(coordinate(p, axis) / size[axis] - index_along(p, axis), -0.5), p.constant(0.5));
  }
};

}  // namespace

void add_value_nodes(Registry& registry) { registry.add<Formula, Mix, Cells>("values"); }

}  // namespace ombre::nodes
