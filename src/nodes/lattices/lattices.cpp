// Lattices of struts: named unit cells, or graphs of edges.
#include <map>

#include "base/math/segment_sets.h"
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
  std::optional<Number> joint, blend;

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
          "Edges in place of a cell: [[from, to], ...] or [[from, to, radius], ...], with points in mm; with a map, "
          "points of a cell from 0 to 1 along u, v and w"},
         {"material", &Lattice::material, "Its material"},
         {"map", &Lattice::map,
          "A map of cells, such as cylinder_cells, whose region the struts fill; their radius in mm holds to first "
          "order where cells are bent"},
         {"joint", &Lattice::joint, "Radius of balls at the ends of struts, in the cells of a map; none: no balls",
          unit::positive_mm},
         {"blend", &Lattice::blend,
          "Radius of fillets along the seams of struts, in the cells of a map; none: sharp seams", unit::positive_mm}},
        no_inputs,
        "lattice(\"bcc\", (10, 10, 10), 1, material=\"gray\");",
        {{"along", &Lattice::along, "Position along the nearest strut, from 0 at its start to 1 at its end",
          Interval(0, 1)},
         {"struts", &Lattice::struts,
          "Its struts as edges: of the unit cell, whose centre is the origin, or as they were given; with a map, "
          "points of a cell from 0 to 1, as edges takes them"}}};
  }

  std::vector<Edge> struts() const {
    if (cell == "none") return edges.value_or(std::vector<Edge>{});
    std::vector<Edge> found;
    const Vec3 centre = map.is_given() ? Vec3{0.5, 0.5, 0.5} : Vec3{};
    for (const Strut& strut : of_cell()) found.push_back({strut.start + centre, strut.end + centre});
    return found;
  }

  bool makes_nothing() const { return cell == "none" && edges && edges->empty(); }

  bool complete(const Reader& reader) {
    const bool is_cell = !(cell == "none"), has_edges = edges && !edges->empty();
    if (map.is_given() && size)
      return reader.refuse("lattice has both a map and the size of its cells",
                           "leave out size: the map says how large cells are");
    if (blend && !map.is_given())
      return reader.refuse("lattice has fillets but no map of cells",
                           "write for example " + spelled::parameter("map", "box_cells((5, 5, 5))") +
                               ", or join struts by a union with a blend");
    if (blend && radius.expression() && radius.expression()->uses("t"))
      return reader.refuse("the radius of struts with fillets changes along them",
                           "leave out t, the place along a strut, which several struts in line share");
    if (joint && !map.is_given())
      return reader.refuse("lattice has joints but no map of cells",
                           "write for example " + spelled::parameter("map", "box_cells((5, 5, 5))") +
                               ", or add spheres at the ends of its struts");
    if (map.is_given() && has_edges && !lies_in_cell(reader)) return false;
    if (is_cell != has_edges) {
      segments_ = is_cell ? of_cell() : of_edges();
      if (map.is_given()) prepare_cell();
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

  // Returns the struts as conical frusta, or why they are not.
  StrutsOrReason beams() const {
    if (joint || blend) return {{}, "struts have balls at their ends, or fillets"};
    const auto common = end_radii(radius);
    if (!common.radii && !all_have_own_radii()) return {{}, common.reason};
    const auto shapes = [&](const std::vector<Strut>& struts, const auto& placed) {
      std::vector<StrutShape> all;
      for (const Strut& strut : struts) {
        const auto radii = strut.own_radius > 0 ? std::array{strut.own_radius, strut.own_radius} : *common.radii;
        all.push_back({placed(strut.start), placed(strut.end), radii[0], radii[1]});
      }
      return all;
    };
    if (!map.is_given()) return {NodeStruts{shapes(segments_, [](Vec3 p) { return p; })}};
    const auto boxes = equal_boxes(map);
    if (!boxes) return {{}, "the cells of their map are no equal boxes along x, y and z"};
    const auto placed = [&](Vec3 p) {
      const Vec3 from_corner = p + Vec3{0.5, 0.5, 0.5};
      return boxes->corner +
             Vec3{from_corner.x * boxes->steps.x, from_corner.y * boxes->steps.y, from_corner.z * boxes->steps.z};
    };
    return {NodeStruts{shapes(cell == "none" ? of_edges() : of_cell(), placed), copies_on(*boxes), map.region}};
  }

  // Returns the number of struts, or 0 on a map, where it is not known.
  size_t count_of_struts() const { return map.is_given() ? 0 : segments_.size(); }

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

  bool all_have_own_radii() const {
    return std::ranges::all_of(segments_, [](const Strut& strut) { return strut.own_radius > 0; });
  }

  // Returns the cells whose struts reach into the region. Struts of mirrored cells do not leave them by more than those
  // of the next cell come to meet them.
  TileCopies copies_on(const EqualBoxes& boxes) const {
    constexpr double rounding = 1e-9;
    TileCopies copies{boxes.steps, {Interval::everything(), Interval::everything(), Interval::everything()}};
    if (!map.region.node) return copies;
    const Box where = map.reach(design_space(), 0);
    const double beyond = is_mirrored() ? 0 : 1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto cells = [&](double at) { return (at - boxes.corner[axis]) / boxes.steps[axis]; };
      copies.indices[static_cast<size_t>(axis)] = {std::floor(cells(where.lo[axis]) + rounding) - beyond,
                                                   std::ceil(cells(where.hi[axis]) - rounding) - 1 + beyond};
    }
    return copies;
  }

  bool is_mirrored() const {
    if (cell == "none") return is_mirrored_graph_;
    return find_unit_cell(cell.text())->is_mirrored;
  }
  // True if all octants are equal, so that only one is evaluated.
  bool is_folded() const { return is_mirrored() && !blend && (radius.constant() || map.is_given()); }

  std::vector<Strut> of_cell() const {
    std::vector<Strut> struts;
    for (const auto& [start, end] : find_unit_cell(cell.text())->struts)
      struts.push_back({{scaled(start), scaled(end)}, 0});
    return struts;
  }

  std::vector<Strut> of_edges() const {
    std::vector<Strut> struts;
    const Vec3 centre = map.is_given() ? Vec3{0.5, 0.5, 0.5} : Vec3{};
    for (const Edge& edge : *edges) struts.push_back({{edge.start - centre, edge.end - centre}, edge.radius});
    return struts;
  }

  bool lies_in_cell(const Reader& reader) const {
    const Box cell_box = Box{{0, 0, 0}, {1, 1, 1}}.expanded(1e-9);
    for (const Edge& edge : *edges)
      if (!cell_box.contains(edge.start) || !cell_box.contains(edge.end))
        return reader.refuse("an edge of lattice leaves the cell of its map",
                             "write points from (0, 0, 0) to (1, 1, 1), the corners of the cell");
    return true;
  }

  // Makes what struts on a map need: whether an eighth of the cell stands for all of it, else the struts of
  // neighbouring cells that reach into this one.
  void prepare_cell() {
    is_mirrored_graph_ = cell == "none" && has_mirror_planes();
    if (!is_folded()) segments_ = with_neighbours();
  }

  static Vec3 flipped(Vec3 p, int axis) {
    p[axis] = 0 - p[axis];
    return p;
  }
  // Returns true if the halves of the cell are mirror images along each axis, and no strut crosses a mirror plane.
  bool has_mirror_planes() const {
    constexpr double tolerance = 1e-9;
    const auto is_same = [](const Strut& a, Vec3 start, Vec3 end, double own_radius) {
      return length(a.start - start) < tolerance && length(a.end - end) < tolerance && a.own_radius == own_radius;
    };
    for (const Strut& strut : segments_)
      for (int axis = 0; axis < 3; ++axis) {
        if (std::min(strut.start[axis], strut.end[axis]) < -tolerance &&
            std::max(strut.start[axis], strut.end[axis]) > tolerance)
          return false;
        if (std::ranges::none_of(segments_, [&](const Strut& other) {
              return is_same(other, flipped(strut.start, axis), flipped(strut.end, axis), strut.own_radius);
            }))
          return false;
      }
    return true;
  }

  // Returns the struts of this cell and those of its neighbours that come nearer to it than half a cell, each once.
  // With fillets, struts in line are one, since seams between them would have a fillet.
  std::vector<Strut> with_neighbours() const {
    const Box near = Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}.expanded(reach_in_cells());
    std::vector<Strut> found = copies_around();
    if (blend) join_in_line(found);
    std::erase_if(found, [&](const Strut& strut) {
      return intersect(hull(Box{strut.start, strut.start}, Box{strut.end, strut.end}), near).is_empty();
    });
    return found;
  }

  // Joins struts of the same radius that share an end and go on straight from one to the other.
  static void join_in_line(std::vector<Strut>& struts) {
    constexpr double tolerance = 1e-9;
    std::map<double, std::vector<Edge3>> of_radius;
    for (const Strut& strut : struts) of_radius[strut.own_radius].push_back({strut.start, strut.end});
    struts.clear();
    for (const auto& [own_radius, edges] : of_radius)
      for (const auto& [start, end] : joined_in_line(edges, tolerance)) struts.push_back({{start, end}, own_radius});
  }

  // Returns the struts of this cell and its neighbours, each once.
  std::vector<Strut> copies_around() const {
    std::vector<Strut> found;
    const auto is_known = [&](const Strut& strut) {
      return std::ranges::any_of(found, [&](const Strut& other) {
        const bool is_forth = length(other.start - strut.start) + length(other.end - strut.end) < 1e-9;
        const bool is_back = length(other.start - strut.end) + length(other.end - strut.start) < 1e-9;
        return (is_forth || is_back) && other.own_radius == strut.own_radius;
      });
    };
    for (int n = 0; n < 27; ++n) {
      const int cell = (n + 13) % 27, row = cell / 3 % 3, layer = cell / 9;  // 0 comes first
      const Vec3 by{cell % 3 - 1.0, row - 1.0, layer - 1.0};
      for (const Strut& strut : segments_) {
        const Strut moved{{strut.start + by, strut.end + by}, strut.own_radius};
        if (!is_known(moved)) found.push_back(moved);
      }
    }
    return found;
  }

  // Returns how far a strut can reach, in cells. Struts as thick as cells leave no gaps, so half a cell is enough.
  double reach_in_cells() const {
    constexpr double most = 0.5;
    if (!map.is_perpendicular || !map.region.node) return most;
    const Box box = map.reach(design_space(), 0);
    const Interval thick = radius.range(box, {{"t", {0, 1}}});
    const double ball = joint ? joint->range(box).hi : 0;
    double greatest = std::max(thick.hi, ball);
    for (const Strut& strut : segments_) greatest = std::max(greatest, strut.own_radius);
    if (blend) greatest += blend->range(box).hi;
    const double least = std::min({map.size.x.range(box).lo, map.size.y.range(box).lo, map.size.z.range(box).lo});
    const double reach = greatest / least * (1 + 1e-6);
    return reach > 0 && reach < most ? reach : most;
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
    const CellMetric metric = CellMetric::at(map, p, is_folded());
    const Slope at = map.place_at(p), place = is_folded() ? folded_into_cell(at) : from_centre_of_cell(at);
    const bool same = has_same_radii();
    OnMap found;
    Field least;
    for (const Strut* strut : struts_here()) {
      const auto [along, squared] = nearest_of_strut(metric, place, strut->start, strut->end);
      const Field measure = same ? squared : sqrt(squared) - strut->radius_at(p, radius, along);
      found.along = least ? select(less(measure, least), along, found.along) : along;
      least = least ? min(measure, least) : measure;
    }
    found.distance = same ? sqrt(least) - *radius.constant() : least;
    if (blend) found.distance = with_fillets(metric, place, p);
    if (const auto squared = joint ? squared_to_joint(metric, place) : std::nullopt)
      found.distance = min(found.distance, sqrt(*squared) - (*joint)(p));
    return found;
  }

  // Returns the distance from the union of struts with fillets of the radius k: max(k, least) - sqrt(sum of max(k - d,
  // 0)^2) for their distances d, as that of union (nodes/solids/blends.h).
  Field with_fillets(const CellMetric& metric, const Slope& place, const Point& p) const {
    const Field k = (*blend)(p);
    Field least, total = p.constant(0);
    for (const Strut* strut : struts_here()) {
      const auto [along, squared] = nearest_of_strut(metric, place, strut->start, strut->end);
      const Field d = sqrt(squared) - strut->radius_at(p, radius, along);
      least = least ? min(d, least) : d;
      total = total + square(max(k - d, 0.0));
    }
    return max(k, least) - sqrt(total);
  }

  bool has_same_radii() const {
    return radius.constant() && std::ranges::all_of(segments_, [](const Strut& s) { return s.own_radius == 0; });
  }

  // Returns true if struts do more at this end of one than go on straight.
  bool is_joint(Vec3 end) const {
    constexpr double tolerance = 1e-9;
    std::vector<Vec3> ways;
    for (const Strut& strut : segments_)
      for (const auto& [from, to] : {std::pair(strut.start, strut.end), std::pair(strut.end, strut.start)})
        if (length(from - end) < tolerance) ways.push_back((1 / length(to - from)) * (to - from));
    return ways.size() != 2 || length(ways[0] + ways[1]) > tolerance;
  }

  // Returns the squared distance to the nearest joint, or nothing if all struts go straight on.
  std::optional<Field> squared_to_joint(const CellMetric& metric, const Slope& place) const {
    std::vector<Vec3> ends;
    for (const Strut* strut : struts_here())
      for (const Vec3 end : {strut->start, strut->end})
        if (is_joint(end) && std::ranges::none_of(ends, [&](Vec3 other) { return length(other - end) < 1e-9; }))
          ends.push_back(end);
    if (ends.empty()) return std::nullopt;
    std::vector<Field> squared;
    for (const Vec3 end : ends) {
      const Slope way = metric.way(Slope{place[0] - end.x, place[1] - end.y, place[2] - end.z});
      squared.push_back(dot_without_zeros(way, way));
    }
    return program::fold(squared, program::min);
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
  bool is_mirrored_graph_ = false;  // of edges on a map
};

}  // namespace

std::optional<StrutMaker> lattice_struts(const design::Node& node) {
  const auto* lattice = dynamic_cast<const NodeOf<Lattice>*>(&node);
  if (!lattice) return std::nullopt;
  return StrutMaker{lattice->data.count_of_struts(), [lattice] { return lattice->data.beams(); }};
}

void add_lattices(Registry& registry) { registry.add<Lattice>("lattices"); }

}  // namespace ombre::nodes
