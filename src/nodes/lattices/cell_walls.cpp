// Walls in the cells of a map: plates along planes of a crystal, honeycombs, folded sheets, and rims.
#include <cmath>
#include <numbers>

#include "base/text/text.h"
#include "design/spec.h"
#include "nodes/common/cell_metric.h"

namespace ombre::nodes {
namespace {

using namespace design;

// Returns the distance in cells to the nearest whole number.
Field from_whole(Field v) { return limited(abs(v - floor_of(v + 0.5)), 0, 0.5); }

// The planes on which a linear function of u, v and w is a whole number.
using Planes = std::vector<Vec3>;

struct Plates {
  CellMap map;
  Choice kind = "cubic";
  Number thickness = 0.5;
  MaterialName material;

  static Spec<Plates> spec() {
    return {
        "plates",
        "Flat walls in the cells of a map, which it fills. Walls have the thickness in mm also where cells are bent.",
        {{"map", &Plates::map, "A map of cells, such as box_cells", required()},
         {"kind", &Plates::kind,
          "cubic: the borders of cells; octet: the faces of octahedra and tetrahedra; cubic_octet: both",
          one_of({"cubic", "octet", "cubic_octet"})},
         {"thickness", &Plates::thickness, "Thickness of the walls", unit::positive_mm},
         {"material", &Plates::material, "Its material"}},
        no_inputs,
        "plates(box_cells((6, 6, 6), min=(0, 0, 0), max=(12, 12, 12)), \"octet\", 0.5, \"red\");"};
  }

  Metric metric() const { return Metric::implicit(); }
  Box reach(const Inputs&, const Box& where, double margin) const { return map.reach(where, margin); }

  Field distance(const Inputs& in, const Point& p) const {
    std::vector<Field> walls;
    for (const auto& [off, squared] : levels(p)) walls.push_back(off / sqrt(squared));
    return map.cut(program::fold(walls, program::min) - thickness(p) * 0.5, in, p);
  }

  Field membership(const Inputs& in, const Point& p, Border border) const {
    const Field half = signed_square(thickness(p) * 0.5);
    std::vector<Field> walls;
    for (const auto& [off, squared] : levels(p)) walls.push_back(at_most(square(off), half * squared, border));
    return map.cut_membership(program::fold(walls, program::logical_or), in, p, border);
  }

 private:
  struct Level {
    Field off, squared_slope;  // distance from the plane in units of the function, and the function's squared slope
  };

  Planes planes() const {
    Planes all;
    if (!(kind == "octet")) all = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (!(kind == "cubic")) all.insert(all.end(), {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}});
    return all;
  }

  std::vector<Level> levels(const Point& p) const {
    const Slope at = map.place_at(p);
    std::vector<Level> found;
    for (const Vec3& plane : planes()) {
      const Slope by{p.constant(plane.x), p.constant(plane.y), p.constant(plane.z)};
      found.push_back({from_whole(dot_without_zeros(by, at)), squared_slope(map, by, p)});
    }
    return found;
  }
};

struct Honeycomb {
  CellMap map;
  Number thickness = 0.5;
  double angle = 30, ratio = 1;
  MaterialName material;

  static Spec<Honeycomb> spec() {
    return {
        "honeycomb",
        "Walls along w of a map of cells, which they fill. They form hexagons, two for each cell of the map. With a "
        "negative angle the hexagons are re-entrant: stretched along one direction, they widen along the other.",
        {{"map", &Honeycomb::map,
          "A map of cells, such as box_cells. Hexagons are regular if cells are sqrt(3) times as long along v as "
          "along u",
          required()},
         {"thickness", &Honeycomb::thickness, "Thickness of the walls", unit::positive_mm},
         {"angle", &Honeycomb::angle, "Angle of the slanted walls from u, before cells are stretched",
          from_to(-80, 80, "deg")},
         {"ratio", &Honeycomb::ratio, "Length of the walls along v, as a multiple of that of the slanted walls",
          positive("")},
         {"material", &Honeycomb::material, "Its material"}},
        no_inputs,
        "honeycomb(box_cells((4, 4, 5), min=(0, 0, 0), max=(16, 16, 5)), 0.4, -20, 1.5, \"red\");"};
  }

  bool complete(const Reader& reader) const {
    if (ratio > -2 * rise()) return true;
    return reader.refuse("slanted walls of this honeycomb would cross",
                         "write a ratio greater than 2 sin(-angle), which is " + format_rounded(-2 * rise()));
  }

  Metric metric() const { return Metric::implicit(); }
  Box reach(const Inputs&, const Box& where, double margin) const { return map.reach(where, margin); }

  Field distance(const Inputs& in, const Point& p) const {
    return map.cut(sqrt(nearest(p)) - thickness(p) * 0.5, in, p);
  }
  Field membership(const Inputs& in, const Point& p, Border border) const {
    return map.cut_membership(at_most(nearest(p), signed_square(thickness(p) * 0.5), border), in, p, border);
  }

 private:
  double rise() const { return std::sin(angle * std::numbers::pi / 180); }

  // Returns the least squared distance to the three walls in a quarter of the cell, in mm^2.
  Field nearest(const Point& p) const {
    // Slanted walls have the length 1, and a cell is as high as two upright and two slanted walls.
    const double height = 2 * (ratio + rise()), end = ratio / 2 / height, begin = (ratio / 2 + rise()) / height;
    const CellMetric metric = CellMetric::at(map, p, true).along_w();
    const Slope at = folded_into_cell(map.place_at(p));
    const auto wall = [&](Vec3 a, Vec3 b) { return nearest_of_strut(metric, at, a, b).squared_distance; };
    return min(wall({0.5, end, 0}, {0, begin, 0}),
               min(wall({0.5, 0, 0}, {0.5, end, 0}), wall({0, begin, 0}, {0, 0.5, 0})));
  }
};

// A function of one variable of period 1, between -1/2 and 1/2, and its derivative.
struct Periodic {
  Field value, slope;

  // Straight lines up and down.
  static Periodic zigzag(Field at) {
    const Field from_start = at - floor_of(at), off = from_start * 2.0 - 1;
    return {limited(abs(off), 0, 1) - 0.5,
            select(less(off, at.builder->constant(0)), at.builder->constant(-2), at.builder->constant(2))};
  }
  static Periodic wave(Field at) {
    const Field phase = at * (2 * std::numbers::pi);
    program::Builder& builder = *at.builder;
    return {builder.apply(program::Op::sin, phase) * 0.5, builder.apply(program::Op::cos, phase) * std::numbers::pi};
  }
};

// Folds has the facets of the fold of K. Miura, "Method of packaging and deployment of large membranes in space", 1985,
// where creases zigzag. Creases along a wave lie in planes of constant w, so that facets mirror each other there.
struct Folds {
  CellMap map;
  Number thickness = 0.5;
  double depth = 0.5;
  Choice profile = "sharp", creases = "straight";
  double swing = 0.25;
  MaterialName material;

  static Spec<Folds> spec() {
    return {
        "folds",
        "Sheets along u and v of a map of cells, one for each cell along w, that rise and fall once in each cell "
        "along u: corrugated or folded sheets, also with creases that zigzag (Miura's fold) or are curved.",
        {{"map", &Folds::map, "A map of cells, such as box_cells", required()},
         {"thickness", &Folds::thickness, "Thickness of the sheets", unit::positive_mm},
         {"depth", &Folds::depth, "Rise from trough to crest, as a share of the cell's length along w", from_to(0, 1)},
         {"profile", &Folds::profile, "sharp: flat between creases; round: a wave", one_of({"sharp", "round"})},
         {"creases", &Folds::creases,
          "Way of crests and troughs: straight along v, zigzag, or curved along a wave of period 1 in v",
          one_of({"straight", "zigzag", "curved"})},
         {"swing", &Folds::swing, "How far creases that are not straight run to and fro along u, in cells",
          from_to(0, 10)},
         {"material", &Folds::material, "Its material"}},
        no_inputs,
        "folds(box_cells((6, 6, 6), min=(0, 0, 0), max=(18, 18, 12)), 0.5, creases=\"zigzag\", "
        "material=\"red\");"};
  }

  Metric metric() const { return Metric::implicit(); }
  Box reach(const Inputs&, const Box& where, double margin) const { return map.reach(where, margin); }

  Field distance(const Inputs& in, const Point& p) const {
    const auto [off, squared] = level(p);
    return map.cut(off / sqrt(squared) - thickness(p) * 0.5, in, p);
  }
  Field membership(const Inputs& in, const Point& p, Border border) const {
    const auto [off, squared] = level(p);
    return map.cut_membership(at_most(square(off), signed_square(thickness(p) * 0.5) * squared, border), in, p, border);
  }

 private:
  struct Level {
    Field off, squared_slope;  // distance from the sheet in cells along w, and the squared slope of that function
  };

  // Returns the cells along w that have a sheet: those of the region.
  Interval layers() const {
    return map.region.node ? map.index.z.range(map.reach(design_space(), 0)) : Interval::everything();
  }

  // Returns the distance, in cells, from a place along w to the nearest sheet, when all are moved to whole numbers.
  Field from_sheet(Field place) const {
    const Field off = from_whole(place);
    const Interval with_sheet = layers();
    return with_sheet.is_bounded() ? max(off, max(with_sheet.lo - place, place - with_sheet.hi)) : off;
  }

  Periodic crease(Field v) const {
    if (creases == "straight") return {v.builder->constant(0), v.builder->constant(0)};
    return creases == "zigzag" ? Periodic::zigzag(v) : Periodic::wave(v);
  }

  Level level(const Point& p) const {
    const Slope at = map.place_at(p);
    const Periodic moved = crease(at[1]);
    const Field along = at[0] + moved.value * swing;
    const Periodic rise = profile == "sharp" ? Periodic::zigzag(along) : Periodic::wave(along);
    const Field by_u = rise.slope * -depth, by_v = by_u * moved.slope * swing;
    return {from_sheet(at[2] - rise.value * depth - 0.5), squared_slope(map, {by_u, by_v, p.constant(1)}, p)};
  }
};

struct Rim {
  CellMap map;
  Number width = 1;
  MaterialName material;

  static Spec<Rim> spec() {
    return {"rim",
            "A band along the border of the surface on which the cells of a map lie: it closes cells that the border "
            "cuts. As high as the cells, and inside of the border.",
            {{"map", &Rim::map, "A map of surface_cells", required()},
             {"width", &Rim::width, "Width of the band", unit::positive_mm},
             {"material", &Rim::material, "Its material"}},
            no_inputs,
            "rim(surface_cells(\"models/insole.off\", (8, 8, 4), height=4, normal=(0, 0, 1)), 2, \"red\");"};
  }

  bool complete(const Reader& reader) const {
    return map.from_border.has_value() || reader.refuse("the map of rim lies on no surface with a border",
                                                        "write a map of surface_cells; other regions have a shell: " +
                                                            spelled::call("shell", {{"thickness", "1"}}));
  }

  Metric metric() const { return Metric::implicit(); }
  Box reach(const Inputs&, const Box& where, double margin) const { return map.reach(where, margin); }
  Field distance(const Inputs& in, const Point& p) const { return map.cut((*map.from_border)(p)-width(p), in, p); }
  Field membership(const Inputs& in, const Point& p, Border border) const {
    return map.cut_membership(at_most((*map.from_border)(p), width(p), border), in, p, border);
  }
};

}  // namespace

void add_cell_walls(Registry& registry) { registry.add<Plates, Honeycomb, Folds, Rim>("lattices"); }

}  // namespace ombre::nodes
