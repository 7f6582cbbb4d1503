// Copies of a solid in rows, grids and circles, and mirrored.
#include "design/spec.h"
#include "nodes/common/mixtures.h"
#include "nodes/common/parameter_checks.h"
#include "nodes/common/shapes.h"
#include "nodes/lattices/lattice_copies.h"
#include "nodes/lattices/turned_copies.h"

namespace ombre::nodes {
namespace {

using namespace design;

// Greatest number of copies that are evaluated at a point, since programs would get too large.
constexpr double most_queries = 10'000;

Domain copy_overlap_choices() { return one_of({"first", "mix", "last"}); }
constexpr std::string_view copy_overlap_doc =
    "Composition where copies overlap: that of the first or last copy, or mix, the mean of all";

// Base of the family: a union of copies, of which only those that matter are evaluated at a point. T has these methods:
// - holding(p) returns the points at which copies that may hold p are evaluated.
// - in_order(p) returns the same points in the order of the copies.
// - nearest_ones(p) returns the points at which copies that may be nearest are evaluated, in the order of the copies.
// - distances(in, p) returns their distances.
// - most_queries_at_once returns the greatest number of these points.
template <class T>
struct Array {
  Metric metric(const Inputs& in) const {
    const Metric metric = in.metric(0);
    return metric.is_implicit() ? metric : Metric::bounded(std::max(1.0, metric.lipschitz));
  }

  Traits traits() const { return {.most_evaluations_of_input = self().most_queries_at_once()}; }

  Field membership(const Inputs& in, const Point& p, Border border) const {
    std::vector<Field> flags;
    for (const Point& q : self().holding(p)) flags.push_back(in.membership(0, q, border));
    return program::fold(flags, program::logical_or);
  }
  Field distance(const Inputs& in, const Point& p) const {
    return program::fold(self().distances(in, p), program::min);
  }

  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    const std::vector<Point> queried = points(p, demand);
    std::vector<Composition> compositions;
    for (const Point& q : queried) compositions.push_back(in.composition(0, q, demand));
    const std::vector<Field> flags = holders(in, p, queried, demand);
    const Choice rule = self().materials;
    return weighted(compositions, rule == "first" ? first_true(flags) : rule == "last" ? last_true(flags) : flags);
  }

  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand) const {
    const std::vector<Point> queried = points(p, demand);
    std::vector<Field> values;
    for (const Point& q : queried) values.push_back(in.attribute(0, name, q, demand));
    const AttributeDeclaration declaration = in.declaration(name);
    return overlapping_values(values, holders(in, p, queried, demand), declaration.overlap,
                              p.constant(default_of(declaration, name)));
  }

  Numbers4 passed(const Inputs& in, std::string_view output, const Point& p) const {
    const std::vector<Point> queried = self().in_order(p);
    const std::vector<Field> flags = first_true(insides(in, queried));
    Numbers4 value = in.output(0, output, queried[0]);
    for (size_t i = 1; i < queried.size(); ++i) value = select(flags[i], in.output(0, output, queried[i]), value);
    return value;
  }

 private:
  const T& self() const { return *static_cast<const T*>(this); }

  static std::vector<Field> insides(const Inputs& in, const std::vector<Point>& queried) {
    std::vector<Field> flags;
    for (const Point& q : queried) flags.push_back(in.inside(0, q));
    return flags;
  }

  std::vector<Point> points(const Point& p, Demand demand) const {
    return demand == Demand::inside ? self().in_order(p) : self().nearest_ones(p);
  }

  // Marks the copies that hold the point, or the nearest one where none does and it matters.
  std::vector<Field> holders(const Inputs& in, const Point& p, const std::vector<Point>& queried, Demand demand) const {
    std::vector<Field> flags = insides(in, queried);
    if (demand == Demand::inside) return flags;
    const Field none = logical_not(program::fold(flags, program::logical_or));
    std::vector<Field> distances = self().distances(in, p);
    distances.resize(queried.size());
    const std::vector<Field> close = nearest(distances);
    for (size_t i = 0; i < flags.size(); ++i) flags[i] = logical_or(flags[i], logical_and(none, close[i]));
    return flags;
  }
};

template <class T>
struct LatticeArray : Array<T> {
  LatticeCopies copies;

  double most_queries_at_once() const { return copies.around_count(); }
  std::vector<Point> holding(const Point& p) const { return copies.holding(p); }
  std::vector<Point> in_order(const Point& p) const { return copies.holding(p); }
  std::vector<Point> nearest_ones(const Point& p) const { return copies.around(p); }

  // Returns the distances of copies. If some copies are not evaluated, the last element is a bound for them.
  std::vector<Field> distances(const Inputs& in, const Point& p) const {
    const bool may_fall_short = in.metric(0).kind == Metric::Kind::bounded && !copies.queries_all();
    std::vector<Field> fields;
    for (const Point& q : copies.around(p)) {
      const Field distance = in.distance(0, q);
      // A bounded distance may be less than the bound for copies that are not evaluated, which would cause jumps.
      fields.push_back(may_fall_short ? max(distance, copies.distance_of_box(q)) : distance);
    }
    if (!copies.queries_all()) fields.push_back(copies.distance_of_others(p));
    return fields;
  }

  Box reach(const Inputs& in, const Box& where, double margin) const {
    // The reach of an exact distance is known. Other inputs are evaluated wherever a copy may matter.
    const bool is_known = margin == 0 || in.metric(0).kind == Metric::Kind::exact;
    const Box reachable = is_known ? copies.original().expanded(margin) : design_space();
    const LatticeCopies::Part part = copies.part(where, reachable);
    Box box = intersect(copies.others(margin), where);
    if (part.originals.is_empty()) return box;
    const Box reached = in.reach(0, part.originals, margin);
    if (reached.is_empty()) return box;
    return hull(box, {reached.lo + part.least, reached.hi + part.greatest});
  }

 protected:
  bool make_copies(const Reader& reader, const Affine& frame, const std::array<LatticeCopies::Row, 3>& rows,
                   const Node& child) {
    copies = LatticeCopies(frame, rows, child.bounds(design_space()));
    if (copies.around_count() <= most_queries) return true;
    return reader.refuse("the copies of " + std::string(reader.node) +
                             " overlap so much that each point would ask more than 10000 of them",
                         "make the steps larger, or give the child an end");
  }
};

bool has_step(const Reader& reader, double step_mm) {
  if (step_mm > 0) return true;
  return reader.refuse("a step of " + std::string(reader.node) + " is 0: the copies would lie on one another",
                       "write how far it is from one copy to the next, in mm");
}

struct ArrayLinear : LatticeArray<ArrayLinear> {
  int count = 2;
  Vec3 step{10, 0, 0};
  Choice materials = "first";

  static Spec<ArrayLinear> spec() {
    return {
        "array_linear",
        "Copies of its child in a row.",
        {{"count", &ArrayLinear::count, "Number of copies, including the child itself", required(from_to(1, 100'000))},
         {"step", &ArrayLinear::step, "Distance from one copy to the next along x, y and z", required(unit::point)},
         {"materials", &ArrayLinear::materials, copy_overlap_doc, copy_overlap_choices()}},
        one_solid,
        "array_linear(4, (6, 0, 1)) { sphere(2, \"red\"); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    if (count > 1 && !has_step(reader, length(step))) return false;
    return make_copies(reader, frame(), {LatticeCopies::Row{step, count}}, *inputs[0]);
  }

 private:
  // Returns a rotation that maps the step to the x axis.
  Affine frame() const {
    if (length(step) == 0) return {};
    const Vec3 u = (1 / length(step)) * step;
    Vec3 least{1, 0, 0};
    if (std::abs(u.y) < std::abs(u.x)) least = {0, 1, 0};
    if (std::abs(u.z) < std::min(std::abs(u.x), std::abs(u.y))) least = {0, 0, 1};
    const Vec3 across = cross(least, u), v = (1 / length(across)) * across;
    return {{u, v, cross(u, v)}, {}};
  }
};

struct ArrayGrid : LatticeArray<ArrayGrid> {
  Counts3 counts{1, 1, 1};
  Vec3 steps{10, 10, 10};
  bool centred = false;
  Choice materials = "first";

  static Spec<ArrayGrid> spec() {
    return {"array_grid",
            "Copies of its child in a grid along x, y and z.",
            {{"counts", &ArrayGrid::counts, "Number of copies along x, y and z", required(from_to(1, 100'000))},
             {"steps", &ArrayGrid::steps, "Distance from one copy to the next along x, y and z", required(unit::point)},
             {"centred", &ArrayGrid::centred, "Centres the grid on the child; else the grid begins at the child"},
             {"materials", &ArrayGrid::materials, copy_overlap_doc, copy_overlap_choices()}},
            one_solid,
            "array_grid((3, 3, 2), (5, 5, 5)) { sphere(2, \"red\"); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    std::array<LatticeCopies::Row, 3> rows;
    for (size_t axis = 0; axis < 3; ++axis) {
      const int i = static_cast<int>(axis);
      rows[axis].count = counts[axis];
      rows[axis].step[i] = steps[i];
      if (counts[axis] > 1 && !has_step(reader, std::abs(steps[i]))) return false;
    }
    return make_copies(reader, {}, rows, *inputs[0]);
  }

  // A centred grid is a grid that starts at the child, translated by half its length.
  std::vector<Point> holding(const Point& p) const { return copies.holding(p.mapped(uncentred())); }
  std::vector<Point> in_order(const Point& p) const { return holding(p); }
  std::vector<Point> nearest_ones(const Point& p) const { return copies.around(p.mapped(uncentred())); }
  std::vector<Field> distances(const Inputs& in, const Point& p) const {
    return LatticeArray::distances(in, p.mapped(uncentred()));
  }
  Box reach(const Inputs& in, const Box& where, double margin) const {
    return image(inverse(uncentred()), LatticeArray::reach(in, image(uncentred(), where), margin));
  }

 private:
  Affine uncentred() const {
    Vec3 half;
    for (int i = 0; i < 3 && centred; ++i) half[i] = 0.5 * (counts[static_cast<size_t>(i)] - 1) * steps[i];
    return Affine::translation(half);
  }
};

struct ArrayPolar : Array<ArrayPolar> {
  int count = 6;
  Vec3 axis{0, 0, 1};
  double angle = 360, radius = 0;
  Vec3 around;
  Choice materials = "first";
  TurnedCopies copies;

  static Spec<ArrayPolar> spec() {
    return {
        "array_polar",
        "Copies of its child around an axis, each turned about it.",
        {{"count", &ArrayPolar::count, "Number of copies, including the child itself", required(from_to(1, 10'000))},
         {"axis", &ArrayPolar::axis, "Direction of the axis; copies are turned about it right-handed", unit::direction},
         {"angle", &ArrayPolar::angle, "Angle from the first copy to the last; 360: evenly all round",
          from_to(-360, 360, "deg")},
         {"radius", &ArrayPolar::radius,
          "Distance by which the child is first moved from the axis: along x, or along y if the axis is x", unit::mm},
         {"around", &ArrayPolar::around, "A point on the axis", unit::point},
         {"materials", &ArrayPolar::materials, copy_overlap_doc, copy_overlap_choices()}},
        one_solid,
        "array_polar(6, radius=8) { cube(3, \"red\"); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    if (!has_direction(reader, "axis", axis)) return false;
    if (angle == 0 && count > 1)
      return reader.refuse("the angle of array_polar is 0: the copies would lie on one another",
                           "write for example " + spelled::parameter("angle", "90"));
    const bool is_full = std::abs(angle) == 360;
    const double degrees = count == 1 ? 0 : angle / (is_full ? count : count - 1);
    const Affine turn_from_here = turned_to_z(axis) * Affine::translation(-around);
    const Affine turn_from_original = Affine::translation({radius, 0, 0}) * turn_from_here;
    copies =
        TurnedCopies(turn_from_here, turn_from_original, count, degrees, is_full, inputs[0]->bounds(design_space()));
    return true;
  }

  double most_queries_at_once() const { return count; }
  std::vector<Point> holding(const Point& p) const { return copies.holding(p); }
  std::vector<Point> in_order(const Point& p) const { return copies.is_in_order() ? copies.holding(p) : copies.all(p); }
  std::vector<Point> nearest_ones(const Point& p) const { return copies.all(p); }
  std::vector<Field> distances(const Inputs& in, const Point& p) const {
    std::vector<Field> fields;
    for (const Point& q : copies.all(p)) fields.push_back(in.distance(0, q));
    return fields;
  }

  Box reach(const Inputs& in, const Box& where, double margin) const {
    return copies.copies(in.reach(0, copies.originals(where), margin), where);
  }
};

struct ArrayMirror : Array<ArrayMirror> {
  Vec3 normal{1, 0, 0}, around;
  Choice materials = "first";

  static Spec<ArrayMirror> spec() {
    return {"array_mirror",
            "Its child and the child's mirror image.",
            {{"normal", &ArrayMirror::normal, "Direction perpendicular to the plane", required(unit::direction)},
             {"around", &ArrayMirror::around, "A point on the plane", unit::point},
             {"materials", &ArrayMirror::materials, copy_overlap_doc, copy_overlap_choices()}},
            one_solid,
            "array_mirror(x) { translate(5, 0, 0) { cone(3, 1, 6, \"red\"); } }"};
  }

  bool complete(const Reader& reader) const { return has_direction(reader, "normal", normal); }

  double most_queries_at_once() const { return 2; }
  std::vector<Point> holding(const Point& p) const { return {p, p.mapped(image_from_here())}; }
  std::vector<Point> in_order(const Point& p) const { return holding(p); }
  std::vector<Point> nearest_ones(const Point& p) const { return holding(p); }
  std::vector<Field> distances(const Inputs& in, const Point& p) const {
    return {in.distance(0, p), in.distance(0, p.mapped(image_from_here()))};
  }

  Box reach(const Inputs& in, const Box& where, double margin) const {
    const Affine mirror = image_from_here();
    const Box box = in.reach(0, hull(where, image(mirror, where)), margin);
    return hull(intersect(box, where), intersect(image(mirror, box), where));
  }

 private:
  Affine image_from_here() const {
    const Vec3 n = (1 / length(normal)) * normal;
    Affine map = Affine::translation(2 * dot(n, around) * n);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) map.rows[static_cast<size_t>(i)][j] -= 2 * n[i] * n[j];
    return map;
  }
};

}  // namespace

void add_arrays(Registry& registry) { registry.add<ArrayLinear, ArrayGrid, ArrayPolar, ArrayMirror>("arrays"); }

}  // namespace ombre::nodes
