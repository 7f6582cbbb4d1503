// Lattices of struts: named unit cells, or graphs of edges.
#include "design/spec.h"
#include "nodes/common/cell_metric.h"
#include "nodes/common/segments.h"
#include "nodes/common/strut_families.h"
#include "nodes/lattices/unit_cells.h"

namespace ombre::nodes {
namespace {

using namespace design;

Domain cell_choices() {
  std::vector<std::string> names = unit_cell_names();
  names.insert(names.begin(), "none");
  return one_of(names);
}

// Struts with hemispherical ends, so that joints are closed.
struct Lattice {
  Choice cell = "none";
  std::optional<Vec3> size;
  Number radius = 1;
  std::optional<std::vector<Edge>> edges;
  MaterialName material;
  CellMap map;

  static Spec<Lattice> spec() {
    return {
        "lattice",
        "Struts with round ends: a unit cell centred on the origin, which tile repeats, the cells of a map, or a graph "
        "of edges.",
        {{"cell", &Lattice::cell, "Name of the unit cell; none: the edges are used", cell_choices()},
         {"size", &Lattice::size, "Size of the unit cell along x, y and z; none: 10 mm, or as the map says",
          unit::positive_mm},
         {"radius", &Lattice::radius, "Radius of the struts; t runs from 0 to 1 along each",
          with_variables({"t"}, unit::positive_mm)},
         {"edges", &Lattice::edges,
          "Edges in place of a cell: [[from, to], ...] or [[from, to, radius], ...], with points in mm"},
         {"material", &Lattice::material, "Its material"},
         {"map", &Lattice::map,
          "A map of cells, such as cylinder_cells, whose region the struts fill; their radius in mm holds to first "
          "order where cells are bent"}},
        no_inputs,
        "lattice(\"bcc\", (10, 10, 10), 1, material=\"gray\");",
        {{"along", &Lattice::along, "Position along the nearest strut, from 0 at its start to 1 at its end",
          Interval(0, 1)}}};
  }

  bool makes_nothing() const { return cell == "none" && edges && edges->empty(); }

  bool complete(const Reader& reader) {
    const bool is_cell = !(cell == "none"), has_edges = edges && !edges->empty();
    if (map.is_given() && (!is_cell || size || !find_unit_cell(cell.text())->is_mirrored))
      return reader.refuse(
          "lattice with a map needs a unit cell with mirror planes, and no size",
          "write for example " + spelled::parameter("cell", "\"bcc\"") + "; the map says how large cells are");
    if (is_cell != has_edges) {
      segments_ = is_cell ? of_cell() : of_edges();
      return true;
    }
    return reader.refuse(
        is_cell ? "lattice has both a unit cell and edges" : "lattice has neither a unit cell nor edges",
        "write " + spelled::call("lattice", {{"cell", "\"bcc\""}, {"size", "(10, 10, 10)"}, {"radius", "1"}}) + " or " +
            spelled::call("lattice", {{"edges", "[[(0, 0, 0), (10, 0, 0)]]"}, {"radius", "1"}}));
  }

  Metric metric() const {
    if (map.is_given()) return Metric::implicit();
    return segments_.size() == 1 ? Metric::exact() : Metric::bounded();
  }

  Traits traits() const {
    Traits traits{.instances = segments_.size()};
    if (cell == "none" || map.is_given()) return traits;
    traits.cell_size = cell_size();
    // The neighbours of a mirrored cell are mirror images, whose struts lie beyond the mirror planes.
    if (is_mirrored()) traits.nearest_copy_is_enough_from = cell_size();
    return traits;
  }

  // Returns the struts as conical frusta, or nothing if they are not.
  std::optional<std::vector<StrutShape>> shapes() const {
    if (map.is_given()) return std::nullopt;
    const auto common = end_radii(radius);
    std::vector<StrutShape> shapes;
    for (const Strut& strut : segments_) {
      if (strut.own_radius == 0 && !common) return std::nullopt;
      const auto radii = strut.own_radius > 0 ? std::array{strut.own_radius, strut.own_radius} : *common;
      shapes.push_back({strut.start, strut.end, radii[0], radii[1]});
    }
    return shapes;
  }

  Box reach(const Inputs&, const Box& where, double margin) const {
    if (map.is_given()) return map.reach(where, margin);
    return tightened(where, [&](const Box& box) {
      const Box wider = box.expanded(margin);
      Box all;
      const double greatest = radius.range(wider, {{"t", {0, 1}}}).hi;
      for (const Strut& strut : segments_) all = hull(all, strut.reach(wider, greatest, 0));
      return intersect(all.expanded(margin), box);
    });
  }

  Field distance(const Inputs& in, const Point& p) const {
    if (map.is_given()) return map.cut(nearest_on_map(p).distance, in, p);
    const Point q = folded(p);
    return nearest(q, struts_here());
  }

  Field membership(const Inputs& in, const Point& p, Border border) const {
    if (map.is_given()) return map.cut_membership(at_most(nearest_on_map(p).distance, 0, border), in, p, border);
    const PartQuery query = border == Border::included ? PartQuery::mix : PartQuery::interior;
    if (const auto parts = table(in, query, p)) return parts->inside;
    const std::vector<const Strut*> near = struts_near(p);
    return near.empty() ? p.constant(0) : at_most(nearest(folded(p), near), 0, border);
  }

  // Returns the position along the strut whose surface is nearest, or, with very many struts, along the first that
  // holds the point.
  Field along(const Ask& ask) const {
    const Point& p = ask.p;
    if (map.is_given()) return nearest_on_map(p).along;
    if (const auto parts = table(ask.in, PartQuery::along, p)) return parts->along;
    const Point q = folded(p);
    Field t, least;
    for (const Strut* strut : struts_here()) {
      const Field here = strut->along(q), d = strut->distance(q, radius);
      t = t ? select(less(d, least), here, t) : here;
      least = least ? min(d, least) : d;
    }
    return t;
  }

 private:
  struct Strut : Segment {
    double own_radius = 0;  // 0 for the lattice's radius

    Field radius_at(const Point& p, const Number& common) const { return radius_at(p, common, {}); }
    // `t` is the position along the strut if it is known.
    Field radius_at(const Point& p, const Number& common, Field t) const {
      if (own_radius > 0) return p.constant(own_radius);
      return common.at(p, [&](std::string_view name) -> std::optional<Field> {
        if (name != "t") return std::nullopt;
        return t ? t : along(p);
      });
    }
    Field distance(const Point& p, const Number& common) const {
      return sqrt(squared_distance(p)) - radius_at(p, common);
    }
    Box reach(const Box& where, double greatest, double margin) const {
      const double r = (own_radius > 0 ? own_radius : greatest) + margin;
      return reach_of_segment(start, end, {r, r, r}, where);
    }
  };

  // The struts as rows of a table.
  class Rows : public PartList {
   public:
    explicit Rows(const Lattice& lattice) : lattice_(lattice) {}
    size_t count() const override { return lattice_.segments_.size(); }
    Box reach(size_t i, const Box& where, double margin) const override {
      return tightened(where, [&](const Box& box) {
        const double greatest = lattice_.radius.range(box, {{"t", {0, 1}}}).hi;
        return intersect(lattice_.segments_[i].reach(box, greatest, margin), box);
      });
    }
    bool uses_cell(size_t) const override { return lattice_.radius.uses_cell(); }
    Field distance(const Inputs&, size_t i, const Point& p) const override {
      return lattice_.segments_[i].distance(p, lattice_.radius);
    }
    Field membership(const Inputs& in, size_t i, const Point& p, Border border) const override {
      return at_most(distance(in, i, p), 0, border);
    }
    Field along(const Inputs&, size_t i, const Point& p) const override { return lattice_.segments_[i].along(p); }
    Composition composition(const Inputs& in, size_t, const Point& p, Demand) const override {
      return in.composition_of(lattice_.material, p);
    }

   private:
    const Lattice& lattice_;
  };

  bool is_mirrored() const { return !(cell == "none") && find_unit_cell(cell.text())->is_mirrored; }
  // True if all octants are equal, so that only one is evaluated.
  bool is_folded() const { return is_mirrored() && (radius.constant() || map.is_given()); }

  std::vector<Strut> of_cell() const {
    std::vector<Strut> struts;
    for (const auto& [start, end] : find_unit_cell(cell.text())->struts)
      struts.push_back({{scaled(start), scaled(end)}, 0});
    return struts;
  }

  std::vector<Strut> of_edges() const {
    std::vector<Strut> struts;
    for (const Edge& edge : *edges) struts.push_back({{edge.start, edge.end}, edge.radius});
    return struts;
  }

  // Cells of a map have the size 1.
  Vec3 cell_size() const { return map.is_given() ? Vec3{1, 1, 1} : size.value_or(Vec3{10, 10, 10}); }
  Vec3 scaled(Vec3 p) const {
    const Vec3 by = cell_size();
    return {p.x * by.x, p.y * by.y, p.z * by.z};
  }

  Point folded(const Point& p) const { return is_folded() ? p.moved_to(abs(p.x), abs(p.y), abs(p.z)) : p; }

  // Returns the struts of the octant into which points are folded, or all struts.
  std::vector<const Strut*> struts_here() const {
    std::vector<const Strut*> found;
    for (const Strut& strut : segments_)
      if (!is_folded() || Box{{0, 0, 0}, cell_size()}.contains(strut.start + 0.5 * (strut.end - strut.start)))
        found.push_back(&strut);
    return found;
  }

  // Returns struts_here() without those that cannot hold a point within the known range of p.
  std::vector<const Strut*> struts_near(const Point& p) const {
    std::vector<const Strut*> found = struts_here();
    if (is_folded() || p.within() == Box::everything()) return found;
    const double greatest = radius.range(p.within(), {{"t", {0, 1}}}).hi;
    std::erase_if(found, [&](const Strut* strut) {
      return intersect(strut->reach(p.within(), greatest, 0), p.within()).is_empty();
    });
    return found;
  }

  struct OnMap {
    Field distance, along;  // from the nearest strut's surface, and the position along that strut
  };
  OnMap nearest_on_map(const Point& p) const {
    const CellMetric metric = CellMetric::at(map, p, true);
    const Slope place = folded_into_cell(map.place_at(p));
    const double* constant = radius.constant();
    OnMap found;
    Field least;
    for (const Strut* strut : struts_here()) {
      const auto [along, squared] = nearest_of_strut(metric, place, strut->start, strut->end);
      const Field measure = constant ? squared : sqrt(squared) - strut->radius_at(p, radius, along);
      found.along = least ? select(less(measure, least), along, found.along) : along;
      least = least ? min(measure, least) : measure;
    }
    found.distance = constant ? sqrt(least) - *constant : least;
    return found;
  }

  std::optional<PartFields> table(const Inputs& in, PartQuery query, const Point& p) const {
    return is_folded() ? std::nullopt : in.many_parts(query, p, Rows(*this));
  }

  // Returns the least distance. Takes a single square root if all struts have the same radius.
  Field nearest(const Point& p, const std::vector<const Strut*>& struts) const {
    const bool same =
        radius.constant() && std::ranges::all_of(struts, [](const Strut* s) { return s->own_radius == 0; });
    std::vector<Field> fields;
    for (const Strut* strut : struts) fields.push_back(same ? strut->squared_distance(p) : strut->distance(p, radius));
    const Field least = program::fold(fields, program::min);
    return same ? sqrt(least) - *radius.constant() : least;
  }

  std::vector<Strut> segments_;
};

}  // namespace

size_t lattice_strut_count(const design::Node& node) {
  const auto* lattice = dynamic_cast<const NodeOf<Lattice>*>(&node);
  return lattice && !lattice->data.map.is_given() ? lattice->data.traits().instances : 0;
}

std::optional<std::vector<StrutShape>> lattice_struts(const design::Node& node) {
  const auto* lattice = dynamic_cast<const NodeOf<Lattice>*>(&node);
  return lattice ? lattice->data.shapes() : std::nullopt;
}

void add_lattices(Registry& registry) { registry.add<Lattice>("lattices"); }

}  // namespace ombre::nodes
