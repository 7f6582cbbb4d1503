// Solids whose distances are added: organic joints and level sets.
#include "design/spec.h"
#include "nodes/common/mixtures.h"
#include "nodes/solids/blends.h"

namespace ombre::nodes {
namespace {

using namespace design;

// The summing operation of the 2023 paper (Figs 17 and 18). Each child gives a falloff of its distance, a smooth step
// from 1 at -blend through 1/2 at 0 to 0 at blend. Points where they add up to at least 1/2 are solid.
struct Sum {
  Number blend = 0;
  Number iso = 0;

  static Spec<Sum> spec() {
    return {
        "sum",
        "Joins its children organically, or takes a level set of their summed distances.",
        {{"blend", &Sum::blend,
          "Distance from its surface up to which a child swells its neighbours; 0: the level set is used",
          unit::not_negative_mm},
         {"iso", &Sum::iso, "Level set, without blend: solid where the distances add up to this or less", unit::mm}},
        many_solids,
        "sum(blend=2) { strut((0, 0, 0), (10, 0, 0), 1, \"red\"); strut((0, 0, 0), (0, 10, 0), 1, \"blue\"); }"};
  }

  bool is_level_set() const { return blend.constant() && *blend.constant() == 0; }
  Metric metric() const { return Metric::implicit(); }

  // Where all children have g >= blend, the falloffs are zero and g is blend.
  Box reach(const Inputs& in, const Box& where, double margin) const {
    const Interval blends = blend.range(where);
    // If distances add up to at most a total, the least is at most the mean.
    const double total = margin + iso.range(where).hi;
    if (is_level_set()) return hull_of(in, where, std::max(0.0, total / static_cast<double>(in.count())));
    if (margin >= blends.lo && margin > 0) return where;
    return hull_of(in, where, in.count() == 1 ? margin : blends.hi);
  }

  Falloff falloff() const {
    const auto weight = [this](Field distance, const Point& p) {
      const Field reach = blend(p);
      const Field t = min(max((reach - distance) / (reach * 2.0), 0.0), p.constant(1));
      return t * t * (3 - t * 2.0);
    };
    return {weight, blend.range(design_space()).hi};
  }

  // Returns the distance at which a single child would give the same total, so that a single child is not changed.
  Field distance(const Inputs& in, const Point& p) const {
    if (is_level_set()) return program::sum(in.distances(p)) - iso(p);
    const Field t = min(program::sum(weights(in, p, falloff())), p.constant(1));
    program::Builder& builder = p.builder();
    // Inverts the smooth step: 1/2 - sin(asin(1 - 2t) / 3).
    const Field angle = builder.apply(program::Op::asin, min(max(1 - t * 2.0, -1.0), p.constant(1))) / 3;
    return blend(p) * (sin(angle) * 2.0);
  }

  Field membership(const Inputs& in, const Point& p, Border border) const {
    if (is_level_set()) return at_most(distance(in, p), 0, border);
    const PartQuery query = border == Border::included ? PartQuery::mix : PartQuery::interior;
    return at_most(p.constant(0.5), influence_of(in, p, query, falloff()).total, border);
  }

  // Children that contain the point count equally. Otherwise those within reach count by their falloff, or else the
  // nearest counts.
  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    if (!is_level_set()) return blended_composition(in, p, demand, "mix", falloff());
    return weighted(in, p, Demand::everywhere, holders_or_nearest(in, p));
  }

  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand) const {
    if (!is_level_set()) return blended_attribute(in, name, p, demand, falloff(), in.declaration(name));
    return overlapping_attribute(in, name, p, Demand::everywhere, holders_or_nearest(in, p), in.declaration(name));
  }

 private:
  static Box hull_of(const Inputs& in, const Box& where, double margin) {
    Box box;
    for (size_t i = 0; i < in.count(); ++i) box = hull(box, in.reach(i, where, margin));
    return box;
  }

  static std::vector<Field> holders_or_nearest(const Inputs& in, const Point& p) {
    std::vector<Field> flags = in.memberships(p, Border::included);
    const Field any = program::fold(flags, program::logical_or);
    const std::vector<Field> close = nearest(in.distances(p));
    for (size_t i = 0; i < flags.size(); ++i) flags[i] = select(any, flags[i], close[i]);
    return flags;
  }
};

}  // namespace

void add_sums(Registry& registry) { registry.add<Sum>("booleans"); }

}  // namespace ombre::nodes
