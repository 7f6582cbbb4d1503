// Solids that are joined, cut and complemented, optionally with a blend along their seams.
#include "design/spec.h"
#include "nodes/common/mixtures.h"
#include "nodes/solids/blends.h"

namespace ombre::nodes {
namespace {

using namespace design;

Field (*const greatest)(Field, Field) = program::max;

constexpr std::string_view overlap_doc =
    "Composition where children overlap: mix, the mean of all, or that of the first or last child";
constexpr std::string_view union_overlap_doc =
    "Composition where children overlap: mix, the mean of all; that of the first or last child; or blend, a mean "
    "weighted by depth, also across seams";

constexpr std::string_view blend_doc = "Radius of the fillet, or size of the chamfer, along seams; 0: sharp seams";
constexpr std::string_view join_doc = "round: a fillet along seams; chamfer: a flat bevel";
Domain join_choices() { return one_of({"round", "chamfer"}); }

// Returns weights of the inputs that contain the point, or of the nearest input where none does and it matters.
std::vector<Field> overlap_weights(const Inputs& in, const Point& p, Demand demand, std::string_view rule) {
  std::vector<Field> flags = in.memberships(p, Border::included);
  if (demand == Demand::everywhere) {
    const Field none = logical_not(program::fold(flags, program::logical_or));
    const std::vector<Field> close = nearest(in.distances(p));
    for (size_t i = 0; i < flags.size(); ++i) flags[i] = logical_or(flags[i], logical_and(none, close[i]));
  }
  if (rule == "first") return first_true(flags);
  if (rule == "last") return last_true(flags);
  return flags;
}

// The minimum or maximum of distances is exact on one side of a surface and a bound on the other.
Metric joined_metric(const Inputs& in) {
  if (in.count() == 1) return in.metric(0);
  Metric metric = Metric::bounded();
  for (size_t i = 0; i < in.count(); ++i) metric = weaker(metric, in.metric(i));
  return metric;
}

Metric blended_metric(const Inputs& in, const Blend& blend) {
  const Metric metric = joined_metric(in);
  if (metric.is_implicit() || in.count() == 1 || blend.is_plain()) return metric;
  return blend.radius.constant() ? Metric::bounded(metric.lipschitz * blend.lipschitz(in.count())) : Metric::implicit();
}

// The shape of the seams of several solids.
struct Seams {
  Number blend_radius = 0;
  Choice join = "round";

  Blend blend() const { return {blend_radius, join == "chamfer"}; }
  bool is_sharp(const Inputs& in) const { return blend().is_plain() || in.count() == 1; }
  Metric metric(const Inputs& in) const { return blended_metric(in, blend()); }
};

struct JoinedSolids : Seams {
  Choice materials = "mix";
  std::vector<NamedWord> attribute_words;

  // Returns the parameters of T, which derives from this class.
  template <class T>
  static std::vector<Parameter<T>> parameters(std::string_view about_materials, Domain rules_of_materials) {
    return {{"materials", &T::materials, about_materials, std::move(rules_of_materials)},
            {"blend", &T::blend_radius, blend_doc, unit::not_negative_mm},
            {"join", &T::join, join_doc, join_choices()},
            {"attributes", &T::attribute_words, attribute_rules_doc, attribute_rules()}};
  }
};

struct Union : JoinedSolids {
  static Spec<Union> spec() {
    return {"union", "The union of its children: all points that are in at least one of them.",
            parameters<Union>(union_overlap_doc, one_of({"mix", "first", "last", "blend"})), many_solids,
            "union(blend=1) { cube(8, \"red\"); translate(4, 4, 4) { sphere(4, \"blue\"); } }"};
  }

  bool complete(const Reader& reader) const {
    if (!(materials == "blend") || !blend().is_plain()) return true;
    return reader.refuse("materials=\"blend\" of union needs a radius to blend over",
                         "write for example " + spelled::call("union", {{"blend", "1"}, {"materials", "\"blend\""}}));
  }

  Box reach(const Inputs& in, const Box& where, double margin) const {
    Box box;
    if (is_sharp(in)) {
      for (size_t i = 0; i < in.count(); ++i) box = hull(box, in.reach(i, where, margin));
      return box;
    }
    const std::vector<size_t> counts = overlap_counts(in, where);
    for (size_t i = 0; i < in.count(); ++i) {
      const double farther = blend().reach(counts[i], where, margin);
      box = hull(box, in.reach(i, where, counts[i] == 1 ? margin : farther));
    }
    return box;
  }

  Field distance(const Inputs& in, const Point& p) const {
    const Field least = program::fold(in.distances(p), program::min);
    if (is_sharp(in)) return least;
    const Field total = program::sum(weights(in, p, blend().falloff()));
    return blend().distance(total, least, p);
  }

  Field membership(const Inputs& in, const Point& p, Border border) const {
    const PartQuery part_query = border == Border::included ? query() : PartQuery::interior;
    if (!is_sharp(in)) {
      const Influence all = influence_of(in, p, part_query, blend().falloff());
      return blend().membership(all.total, all.any, p, border);
    }
    const auto parts = in.many_parts(part_query, p);
    if (!parts) return program::fold(in.memberships(p, border), program::logical_or);
    Field any = parts->inside;
    for (const size_t i : parts->others) any = logical_or(any, in.membership(i, p, border));
    return any;
  }

  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    if (in.count() == 1) return in.composition(0, p, demand);
    if (!blend().is_plain()) return blended_composition(in, p, demand, materials.text(), blend().falloff());
    const auto parts = demand == Demand::inside ? in.many_parts(query(), p) : std::nullopt;
    if (parts && materials == "mix") return mixed(in, p, *parts);
    if (parts && parts->others.empty()) return parts->composition;
    if (parts && are_together(*parts, in.count())) return in_order(in, p, *parts);
    return weighted(in, p, demand, overlap_weights(in, p, demand, materials.text()));
  }

  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand) const {
    if (in.count() == 1) return in.attribute(0, name, p, demand);
    const AttributeDeclaration here = in_place_of(in.declaration(name), attribute_words);
    if (!blend().is_plain()) return blended_attribute(in, name, p, demand, blend().falloff(), here);
    return overlapping_attribute(in, name, p, demand, overlap_weights(in, p, demand, "mix"), here);
  }

 private:
  // Returns for each input the number of inputs whose influence may reach it, itself included. With very many inputs it
  // counts all.
  std::vector<size_t> overlap_counts(const Inputs& in, const Box& where) const {
    constexpr size_t few = 64;
    const size_t count = in.count();
    if (count > few) return std::vector<size_t>(count, count);
    std::vector<Box> boxes;
    for (size_t i = 0; i < count; ++i) boxes.push_back(in.reach(i, where, blend_radius.range(where).hi));
    std::vector<size_t> counts(count, 1);
    for (size_t i = 0; i < count; ++i)
      for (size_t j = 0; j < i; ++j) {
        if (intersect(boxes[i], boxes[j]).is_empty()) continue;
        ++counts[i];
        ++counts[j];
      }
    return counts;
  }

  // Returns the number of inputs before those of the table.
  static size_t before(const PartFields& parts) {
    size_t count = 0;
    while (count < parts.others.size() && parts.others[count] == count) ++count;
    return count;
  }

  // True if the inputs of the table are consecutive.
  static bool are_together(const PartFields& parts, size_t count) {
    const size_t first = before(parts), end = first + count - parts.others.size();
    return first == parts.others.size() || parts.others[first] == end;
  }

  // Returns the composition of the first or last input that holds the point, with those of the table as one.
  Composition in_order(const Inputs& in, const Point& p, const PartFields& parts) const {
    std::vector<Composition> compositions;
    std::vector<Field> flags;
    for (const size_t i : parts.others) {
      compositions.push_back(in.composition(i, p, Demand::inside));
      flags.push_back(in.inside(i, p));
    }
    const auto at = static_cast<std::ptrdiff_t>(before(parts));
    compositions.insert(compositions.begin() + at, parts.composition);
    flags.insert(flags.begin() + at, parts.inside);
    return weighted(compositions, materials == "first" ? first_true(flags) : last_true(flags));
  }

  PartQuery query() const {
    return materials == "first" ? PartQuery::first : materials == "last" ? PartQuery::last : PartQuery::mix;
  }
};

// The complement of the blended joint of the solids' complements.
struct Carved {
  std::vector<Field> depths;  // depth of the point in each solid, its negated distance
  Blend blend;

  Field total(const Point& p) const {
    const Falloff falloff = blend.falloff();
    std::vector<Field> values;
    for (const Field depth : depths) values.push_back(falloff.weight(depth, p));
    return program::sum(values);
  }
  Field distance(const Point& p) const { return -blend.distance(total(p), program::fold(depths, program::min), p); }
  // A point is in the whole if it is not in the joint of the complements. The surface belongs to only one of them.
  Field membership(Field any_outside, const Point& p, Border border) const {
    return logical_not(blend.membership(total(p), any_outside, p, other(border)));
  }
};

struct Intersection : JoinedSolids {
  static Spec<Intersection> spec() {
    return {"intersection", "The intersection of its children: all points that are in every one of them.",
            parameters<Intersection>(overlap_doc, one_of({"mix", "first", "last"})),
            grouped_solids(OfNothing::gives_nothing), "intersection() { cube(8, \"red\"); sphere(5, \"red\"); }"};
  }

  // Children without bounds are evaluated within the bounds of the others.
  Box reach(const Inputs& in, const Box& where, double margin) const {
    Box box = where;
    for (int round = 0; round < 2; ++round)
      for (size_t i = 0; i < in.count() && !box.is_empty(); ++i) box = intersect(box, in.reach(i, box, margin));
    return box;
  }

  Field distance(const Inputs& in, const Point& p) const {
    return is_sharp(in) ? program::fold(in.distances(p), greatest) : carved(in, p).distance(p);
  }
  Field membership(const Inputs& in, const Point& p, Border border) const {
    const Field all = program::fold(in.memberships(p, border), program::logical_and);
    return is_sharp(in) ? all : carved(in, p).membership(logical_not(all), p, border);
  }

  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    if (demand == Demand::everywhere) return weighted(in, p, demand, overlap_weights(in, p, demand, materials.text()));
    // A point in the intersection is inside every child.
    if (materials == "first") return in.composition(0, p, demand);
    if (materials == "last") return in.composition(in.count() - 1, p, demand);
    return weighted(in, p, demand, std::vector<Field>(in.count(), p.constant(1)));
  }

  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand) const {
    const auto flags = demand == Demand::inside ? std::vector<Field>(in.count(), p.constant(1))
                                                : overlap_weights(in, p, demand, "mix");
    return overlapping_attribute(in, name, p, demand, flags, in_place_of(in.declaration(name), attribute_words));
  }

 private:
  Carved carved(const Inputs& in, const Point& p) const {
    std::vector<Field> depths = in.distances(p);
    for (Field& depth : depths) depth = -depth;
    return {depths, blend()};
  }
};

struct Difference : Seams {
  static Spec<Difference> spec() {
    return {"difference",
            "Its first child without all others: the points that are in the first and in none of the others.",
            {{"blend", &Difference::blend_radius, blend_doc, unit::not_negative_mm},
             {"join", &Difference::join, join_doc, join_choices()}},
            grouped_solids(OfNothing::cuts_nothing),
            "difference() { cube(8, \"red\"); cylinder(2, 10); }"};
  }

  Field distance(const Inputs& in, const Point& p) const {
    if (!is_sharp(in)) return carved(in, p).distance(p);
    std::vector<Field> distances = in.distances(p);
    for (size_t i = 1; i < distances.size(); ++i) distances[i] = -distances[i];
    return program::fold(distances, greatest);
  }

  // The surface of a solid that is cut away belongs to both.
  Field membership(const Inputs& in, const Point& p, Border border) const {
    std::vector<Field> flags = in.memberships(p, other(border));
    flags[0] = in.membership(0, p, border);
    const Field left = without(flags);
    return is_sharp(in) ? left : carved(in, p).membership(logical_not(left), p, border);
  }

 private:
  static Field without(std::vector<Field>& flags) {
    for (size_t i = 1; i < flags.size(); ++i) flags[i] = logical_not(flags[i]);
    return program::fold(flags, program::logical_and);
  }

  Carved carved(const Inputs& in, const Point& p) const {
    std::vector<Field> depths = in.distances(p);
    depths[0] = -depths[0];
    return {depths, blend()};
  }
};

struct Negate {
  static Spec<Negate> spec() {
    return {"negate",
            "Everything outside its child. It is unbounded: use it inside an intersection.",
            {},
            {1, 1, false, OfNothing::counts},
            "intersection() { cube(8, \"red\"); negate() { sphere(5, \"red\"); } }"};
  }

  Box reach(const Inputs&, const Box& where, double) const { return where; }
  Field distance(const Inputs& in, const Point& p) const { return -in.distance(0, p); }
  Field membership(const Inputs& in, const Point& p, Border border) const {
    return logical_not(in.membership(0, p, other(border)));
  }

  Composition composition(const Inputs& in, const Point& p, Demand) const {
    return in.composition(0, p, Demand::everywhere);
  }
  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand) const {
    return in.attribute(0, name, p, Demand::everywhere);
  }
};

// The result of a loop without passes, of a false condition or of a text without letters.
struct Empty {
  static constexpr bool is_nothing_itself = true;

  static Spec<Empty> spec() {
    return {"empty",
            "An empty solid, without any point. Solids made from it alone, or cut out of it, are empty too.",
            {},
            no_inputs,
            "union() { sphere(4, \"red\"); empty(); }"};
  }

  Metric metric() const { return Metric::bounded(); }
  Box bounds(const Box&) const { return Box::empty(); }
  // Larger than the distance between any two points of a design.
  Field distance(const Point& p) const { return p.constant(10 * design_limit_mm); }
};

}  // namespace

void add_booleans(Registry& registry) { registry.add<Union, Intersection, Difference, Negate, Empty>("booleans"); }

}  // namespace ombre::nodes
