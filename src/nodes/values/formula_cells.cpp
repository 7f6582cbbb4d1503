// Maps of cells that formulas give, for example for spacing that changes along an axis.
#include "nodes/common/cell_map.h"
#include "nodes/values/cell_folds.h"
#include "nodes/values/cell_outputs.h"

namespace ombre::nodes {
namespace {

using namespace design;

// Returns the formula that is a variable.
Number variable(const char* name) {
  Diagnostics none;
  return *expr::Expression::parse(name, {}, none);
}

struct FormulaCells : CellOutputs<FormulaCells> {
  Number u = variable("u"), v = variable("v"), w = variable("w");
  CellMap of;
  SolidName region;

  static Spec<FormulaCells> spec() {
    const Domain in_cells = with_variables({"u", "v", "w"});
    return {"formula_cells",
            "A map of cells from formulas of x, y and z, or of the place u, v, w in another map, for example with "
            "cells that become smaller along an axis.",
            {{"u", &FormulaCells::u, "Place along u, in cells", in_cells},
             {"v", &FormulaCells::v, "Place along v", in_cells},
             {"w", &FormulaCells::w, "Place along w", in_cells},
             {"of", &FormulaCells::of, "The other map; its region is that of this map unless another is given"},
             {"region", &FormulaCells::region, "A solid that the cells fill"}},
            no_inputs,
            "tpms(\"gyroid\", map=formula_cells(v=\"v + 0.1*v^2\", of=cylinder_cells(7, 10, 16, count=(12, 3, 1))), "
            "thickness=0.4, material=\"red\");",
            outputs()};
  }

  bool complete(const Reader& reader) {
    if (!of.is_given() && (uses_other_map(u) || uses_other_map(v) || uses_other_map(w)))
      return reader.refuse("formula_cells has no map that gives u, v and w",
                           "write for example " + spelled::parameter("u", "\"x/5\"") + ", " +
                               spelled::parameter("v", "\"y/5\"") + ", " + spelled::parameter("w", "\"z/5\"") +
                               ", or a map as of");
    for (const auto& [name, number] : {std::pair{"u", &u}, {"v", &v}, {"w", &w}})
      if (number->constant())
        return reader.refuse(
            std::string(name) + " of formula_cells is the same everywhere, so cells have no volume",
            "write a formula that grows along a direction, for example " + spelled::parameter(name, "\"x/5\""));
    if (!region.node) region = of.region;
    has_region = region.node != nullptr;
    return !has_region || does_not_fold(reader);
  }

  Slope cells_at(const Point& p) const {
    return of.is_given() ? cells_from(p, of.place_at(p)) : Slope{u(p), v(p), w(p)};
  }
  // Uses the slopes of the other map, if the formula depends on space through u, v and w alone.
  Slope slope(const Point& p, size_t n) const {
    if (!of.is_given()) return CellOutputs::slope(p, n);
    const Slope at = of.place_at(p);
    const auto by = program::gradient(cells_from(p, at)[n], Point::of(at[0], at[1], at[2]));
    if (!by) return CellOutputs::slope(p, n);
    Slope sum{p.constant(0), p.constant(0), p.constant(0)};
    for (size_t axis = 0; axis < 3; ++axis) {
      const Slope inner = of.slope_at(axis, p);
      for (size_t part = 0; part < 3; ++part)
        sum[part] = sum_without_zeros(sum[part], product_without_zeros((*by)[axis], inner[part]));
    }
    return sum;
  }

  Field outside(const Ask& ask) const { return ask.in.distance_to(region, ask.p); }
  Box region_within(const Box& where) const { return box_of(region, where); }

 private:
  static bool uses_other_map(const Number& number) {
    const expr::Expression* formula = number.expression();
    return formula && (formula->uses("u") || formula->uses("v") || formula->uses("w"));
  }

  Slope cells_from(const Point& p, const Slope& at) const {
    const expr::Variables variables = [&](std::string_view name) -> std::optional<Field> {
      return name == "u"   ? std::optional(at[0])
             : name == "v" ? std::optional(at[1])
             : name == "w" ? std::optional(at[2])
                           : std::nullopt;
    };
    return {u.at(p, variables), v.at(p, variables), w.at(p, variables)};
  }

  bool does_not_fold(const Reader& reader) const {
    const Box box = region_within(design_space());
    if (!has_ends(box)) return true;
    std::vector<NodePtr> roots{NodePtr(NodePtr(), region.node)};
    for (const Number& number : {u, v, w}) add_nodes_of(number, roots);
    if (of.is_given()) roots.push_back(NodePtr(NodePtr(), of.from.node));
    constexpr int side = 24;
    const auto folded = find_folded_cell(
        reader, roots, box, side, [&](Lowering& lowering, const Point& p) { return outside_of(lowering, region, p); },
        [&](Lowering&, const Point& p) {
          return determinant_of({slope(p, 0), slope(p, 1), slope(p, 2)});
        });
    return !folded || refuse_folded(reader, *folded,
                                    "make u, v and w grow along directions of their own everywhere in the region, or "
                                    "make the region smaller");
  }
};

}  // namespace

void add_formula_cells(Registry& registry) { registry.add<FormulaCells>("cells"); }

}  // namespace ombre::nodes
