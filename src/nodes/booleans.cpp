// Solids joined, cut and complemented.
#include "design/spec.h"
#include "nodes/all_nodes.h"
#include "nodes/mixtures.h"

namespace ombre::nodes {
namespace {

using namespace design;

Field (*const greatest)(Field, Field) = program::max;

Domain overlap_choices() { return one_of({"mix", "first", "last"}); }
constexpr std::string_view overlap_doc =
    "Where inputs overlap: mix adds their compositions and normalises, first and last let one take precedence";

// Weights of inputs that contain the point; where none does and it matters, the nearest counts.
std::vector<Field> overlap_weights(const Inputs& in, const Point& p, Demand demand, std::string_view rule) {
  std::vector<Field> marks = in.insides(p);
  if (demand == Demand::everywhere) {
    const Field none = logical_not(program::fold(marks, program::logical_or));
    const std::vector<Field> close = nearest(in.distances(p));
    for (size_t i = 0; i < marks.size(); ++i) marks[i] = logical_or(marks[i], logical_and(none, close[i]));
  }
  if (rule == "first") return first_true(marks);
  if (rule == "last") return last_true(marks);
  return marks;
}

// Least and greatest distances are exact on one side of a surface, and bounds on the other.
Metric joined_metric(const Inputs& in) {
  if (in.count() == 1) return in.metric(0);
  Metric metric = Metric::bounded();
  for (size_t i = 0; i < in.count(); ++i) metric = weaker(metric, in.metric(i));
  return metric;
}

struct Union {
  Choice materials = "mix";

  static Spec<Union> spec() {
    return {"union",
            "booleans",
            "What is in any of its children.",
            {{"materials", &Union::materials, overlap_doc, overlap_choices()}},
            many_solids,
            "union() { cube(8, \"red\"); translate(4, 4, 4) { sphere(4, \"blue\"); } }"};
  }

  Metric metric(const Inputs& in) const { return joined_metric(in); }

  Box reach(const Inputs& in, const Box& where, double margin) const {
    Box box;
    for (size_t i = 0; i < in.count(); ++i) box = hull(box, in.reach(i, where, margin));
    return box;
  }

  Field distance(const Inputs& in, const Point& p) const { return program::fold(in.distances(p), program::min); }

  Field inside(const Inputs& in, const Point& p) const {
    const auto parts = in.many_parts(query(), p);
    if (!parts) return program::fold(in.insides(p), program::logical_or);
    Field any = parts->inside;
    for (const size_t i : parts->others) any = logical_or(any, in.inside(i, p));
    return any;
  }

  Field interior(const Inputs& in, const Point& p) const {
    const auto parts = in.many_parts(PartQuery::interior, p);
    if (!parts) return program::fold(in.interiors(p), program::logical_or);
    Field any = parts->inside;
    for (const size_t i : parts->others) any = logical_or(any, in.interior(i, p));
    return any;
  }

  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    if (in.count() == 1) return in.composition(0, p, demand);
    const auto parts = demand == Demand::inside ? in.many_parts(query(), p) : std::nullopt;
    if (parts && materials == "mix") return mixed(in, p, *parts);
    if (parts && parts->others.empty()) return parts->composition;
    if (parts && are_together(*parts, in.count())) return in_order(in, p, *parts);
    return weighted(in, p, demand, overlap_weights(in, p, demand, materials.text()));
  }

  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand) const {
    if (in.count() == 1) return in.attribute(0, name, p, demand);
    return overlapping_attribute(in, name, p, demand, overlap_weights(in, p, demand, "mix"), in.declaration(name));
  }

 private:
  // How many inputs stand before those of the table.
  static size_t before(const PartFields& parts) {
    size_t count = 0;
    while (count < parts.others.size() && parts.others[count] == count) ++count;
    return count;
  }

  // Do the inputs of the table follow one another?
  static bool are_together(const PartFields& parts, size_t count) {
    const size_t first = before(parts), end = first + count - parts.others.size();
    return first == parts.others.size() || parts.others[first] == end;
  }

  // The first or last that holds the point, where those of the table count as one.
  Composition in_order(const Inputs& in, const Point& p, const PartFields& parts) const {
    std::vector<Composition> compositions;
    std::vector<Field> marks;
    for (const size_t i : parts.others) {
      compositions.push_back(in.composition(i, p, Demand::inside));
      marks.push_back(in.inside(i, p));
    }
    const auto at = static_cast<std::ptrdiff_t>(before(parts));
    compositions.insert(compositions.begin() + at, parts.composition);
    marks.insert(marks.begin() + at, parts.inside);
    return weighted(compositions, materials == "first" ? first_true(marks) : last_true(marks));
  }

  PartQuery query() const {
    return materials == "mix" ? PartQuery::mix : materials == "first" ? PartQuery::first : PartQuery::last;
  }
};

struct Intersection {
  Choice materials = "mix";

  static Spec<Intersection> spec() {
    return {"intersection",
            "booleans",
            "What is in all of its children.",
            {{"materials", &Intersection::materials, overlap_doc, overlap_choices()}},
            grouped_solids,
            "intersection() { cube(8, \"red\"); sphere(5, \"red\"); }"};
  }

  Metric metric(const Inputs& in) const { return joined_metric(in); }

  // Children without bounds of their own are asked within those of the others.
  Box reach(const Inputs& in, const Box& where, double margin) const {
    Box box = where;
    for (int round = 0; round < 2; ++round)
      for (size_t i = 0; i < in.count() && !box.is_empty(); ++i) box = intersect(box, in.reach(i, box, margin));
    return box;
  }

  Field distance(const Inputs& in, const Point& p) const { return program::fold(in.distances(p), greatest); }
  Field inside(const Inputs& in, const Point& p) const { return program::fold(in.insides(p), program::logical_and); }
  Field interior(const Inputs& in, const Point& p) const {
    return program::fold(in.interiors(p), program::logical_and);
  }

  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    if (demand == Demand::everywhere) return weighted(in, p, demand, overlap_weights(in, p, demand, materials.text()));
    // Inside the whole is inside each.
    if (materials == "first") return in.composition(0, p, demand);
    if (materials == "last") return in.composition(in.count() - 1, p, demand);
    return weighted(in, p, demand, std::vector<Field>(in.count(), p.constant(1)));
  }

  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand) const {
    const auto marks = demand == Demand::inside ? std::vector<Field>(in.count(), p.constant(1))
                                                : overlap_weights(in, p, demand, "mix");
    return overlapping_attribute(in, name, p, demand, marks, in.declaration(name));
  }
};

struct Difference {
  static Spec<Difference> spec() {
    return {"difference", "booleans",     "What is in its first child and in none of the others.",
            {},           grouped_solids, "difference() { cube(8, \"red\"); cylinder(2, 10); }"};
  }

  Metric metric(const Inputs& in) const { return joined_metric(in); }

  Field distance(const Inputs& in, const Point& p) const {
    std::vector<Field> distances = in.distances(p);
    for (size_t i = 1; i < distances.size(); ++i) distances[i] = -distances[i];
    return program::fold(distances, greatest);
  }

  // The surface of what is cut away belongs to both.
  Field inside(const Inputs& in, const Point& p) const {
    std::vector<Field> marks = in.interiors(p);
    marks[0] = in.inside(0, p);
    for (size_t i = 1; i < marks.size(); ++i) marks[i] = logical_not(marks[i]);
    return program::fold(marks, program::logical_and);
  }

  Field interior(const Inputs& in, const Point& p) const {
    std::vector<Field> marks = in.insides(p);
    marks[0] = in.interior(0, p);
    for (size_t i = 1; i < marks.size(); ++i) marks[i] = logical_not(marks[i]);
    return program::fold(marks, program::logical_and);
  }
};

struct Negate {
  static Spec<Negate> spec() {
    return {"negate", "booleans", "Everything that is not in its child. Without bounds: use it inside an intersection.",
            {},       one_solid,  "intersection() { cube(8, \"red\"); negate() { sphere(5, \"red\"); } }"};
  }

  Box reach(const Inputs&, const Box& where, double) const { return where; }
  Field distance(const Inputs& in, const Point& p) const { return -in.distance(0, p); }
  Field inside(const Inputs& in, const Point& p) const { return logical_not(in.interior(0, p)); }
  Field interior(const Inputs& in, const Point& p) const { return logical_not(in.inside(0, p)); }

  Composition composition(const Inputs& in, const Point& p, Demand) const {
    return in.composition(0, p, Demand::everywhere);
  }
  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand) const {
    return in.attribute(0, name, p, Demand::everywhere);
  }
};

}  // namespace

void add_booleans(Registry& registry) { registry.add<Union, Intersection, Difference, Negate>(); }

}  // namespace ombre::nodes
