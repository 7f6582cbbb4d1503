// Maps of cells between the surfaces of two solids.
#include "nodes/common/cell_map.h"
#include "nodes/common/child_distance.h"
#include "nodes/values/cell_counts.h"
#include "nodes/values/cell_folds.h"
#include "nodes/values/cell_outputs.h"

namespace ombre::nodes {
namespace {

using namespace design;

constexpr int tested_along = 16;    // points along each axis
constexpr double least_gap = 1e-9;  // mm; where the surfaces meet, cells have no height

// Returns g of a solid at a point, during lowering or while the node is made.
using Off = std::function<Field(const SolidName&, const Point&)>;

struct BetweenCells : CellOutputs<BetweenCells> {
  SolidName inner, outer;
  CellMap of;
  int layers = 1;

  static Spec<BetweenCells> spec() {
    std::vector<OutputSpec<BetweenCells>> all = outputs();
    all.emplace_back("gap", static_cast<Field (BetweenCells::*)(const Ask&) const>(&BetweenCells::gap),
                     "Sum of the distances from both surfaces: the thickness of the space between them, mm");
    return {
        "between_cells",
        "A map of cells in the space between the surfaces of two solids, one inside the other: w is the distance "
        "from the inner surface as a share of both distances, u and v are those of another map.",
        {{"inner", &BetweenCells::inner, "The solid on whose surface cells begin", required()},
         {"outer", &BetweenCells::outer, "The solid at whose surface they end", required()},
         {"of", &BetweenCells::of, "The map that gives u and v, such as ball_cells; its region cuts cells", required()},
         {"layers", &BetweenCells::layers, "Number of cells from one surface to the other", whole_from_one()}},
        no_inputs,
        "tpms(\"gyroid\", map=between_cells(sphere(8), sphere(10), ball_cells(7, 11, -60, 60, count=(12, 5, 1))), "
        "thickness=0.4, material=\"red\");",
        std::move(all)};
  }

  bool complete(const Reader& reader) {
    for (const auto& [name, solid] : {std::pair("inner", &inner), {"outer", &outer}})
      warn_of_implicit_distance(reader, *solid->node, std::string(name) + " of between_cells");
    counts.z = layers;
    const Box box = region_within(design_space());
    if (box.is_empty())
      return reader.refuse("the solid outer of between_cells lies outside of the region of its map",
                           "make the map around the solids");
    if (!has_ends(box)) return true;
    return has_a_gap(reader, box) && does_not_fold(reader, box);
  }

  Slope cells_at(const Ask& ask) const { return cells_by(off_by(ask), ask.p); }
  Slope slope(const Ask& ask, size_t n) const { return slope_by(off_by(ask), ask.p, n); }
  Field gap(const Ask& ask) const { return gap_by(off_by(ask), ask.p); }

  Field outside(const Ask& ask) const { return outside_by(off_by(ask), ask.p); }
  Field inside(const Ask& ask) const {
    const Field between = logical_and(ask.in.inside_of(outer, ask.p), logical_not(ask.in.inside_of(inner, ask.p)));
    return of.region.node ? logical_and(between, ask.in.inside_of(of.region, ask.p)) : between;
  }
  Box region_within(const Box& where) const { return of.reach(box_of(outer, where), 0); }

 private:
  static Off off_by(const Ask& ask) {
    return [&in = ask.in](const SolidName& solid, const Point& p) { return in.distance_to(solid, p); };
  }

  Field gap_by(const Off& off, const Point& p) const { return max(off(inner, p) - off(outer, p), least_gap); }

  Slope cells_by(const Off& off, const Point& p) const {
    const Slope at = of.place_at(p);
    return {at[0], at[1], off(inner, p) / gap_by(off, p) * static_cast<double>(layers)};
  }

  // The share s = a / (a - b) of the distances a and b has the derivative ((1 - s) a' + s b') / (a - b).
  Slope slope_by(const Off& off, const Point& p, size_t n) const {
    if (n < 2) return of.slope_at(n, p);
    const Field gap = gap_by(off, p), share = off(inner, p) / gap;
    const Slope of_inner = slope_at([&](const Point& q) { return off(inner, q); }, p);
    const Slope of_outer = slope_at([&](const Point& q) { return off(outer, q); }, p);
    const auto part = [&](size_t axis) {
      const Field mixed = sum_without_zeros(product_without_zeros(of_inner[axis], 1.0 - share),
                                            product_without_zeros(of_outer[axis], share));
      return is_zero(mixed) ? mixed : mixed / gap * static_cast<double>(layers);
    };
    return {part(0), part(1), part(2)};
  }

  Field outside_by(const Off& off, const Point& p) const {
    const Field between = program::max(off(outer, p), -off(inner, p));
    return of.region.node ? program::max(between, off(of.region, p)) : between;
  }

  std::vector<NodePtr> roots() const {
    std::vector<NodePtr> all;
    for (const Node* node : {inner.node, outer.node, of.from.node}) all.emplace_back(NodePtr(), node);
    return all;
  }

  // Returns false and adds an error if no tested point is nearer to the inside of `outer` than to that of `inner`.
  bool has_a_gap(const Reader& reader, const Box& box) const {
    const MadeFields fields(reader, roots(), box, [&](Lowering& lowering, const Point& p) {
      return std::vector{outside_of(lowering, inner, p) - outside_of(lowering, outer, p)};
    });
    std::vector<double> values;
    if (find_tested_point(box, tested_along, [&](Vec3 at) { return fields.at(at, values)[0] > 0; })) return true;
    return reader.refuse("no space lies between the surfaces of between_cells",
                         "the solid inner must lie inside of the solid outer; exchange them if it does not");
  }

  bool does_not_fold(const Reader& reader, const Box& box) const {
    const auto off_by = [](Lowering& lowering) -> Off {
      return [&lowering](const SolidName& solid, const Point& q) { return outside_of(lowering, solid, q); };
    };
    const auto folded = find_folded_cell(
        reader, roots(), box, tested_along,
        [&](Lowering& lowering, const Point& p) { return outside_by(off_by(lowering), p); },
        [&](Lowering& lowering, const Point& p) {
          const Off off = off_by(lowering);
          return determinant_of({slope_by(off, p, 0), slope_by(off, p, 1), slope_by(off, p, 2)});
        });
    return !folded || refuse_folded(reader, *folded,
                                    "give a map whose u and v run along the surfaces there, or cut them off by the "
                                    "region of the map");
  }
};

}  // namespace

void add_between_cells(Registry& registry) { registry.add<BetweenCells>("cells"); }

}  // namespace ombre::nodes
