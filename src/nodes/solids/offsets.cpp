// Solids bounded by level sets of a child's distance: grown, shrunk, hollowed.
#include "design/spec.h"
#include "nodes/common/child_distance.h"

namespace ombre::nodes {
namespace {

using namespace design;

// A level set of an exact distance has an exact distance on one side, and a bound of it on the other.
Metric level_metric(const Inputs& in) {
  const Metric metric = in.metric(0);
  return metric.is_implicit() ? metric : Metric::bounded(metric.lipschitz);
}

// Returns a box around the points of `where` at which the input's g is at most `level`.
Box level_reach(const Inputs& in, const Box& where, double level) {
  if (level >= 0) return in.reach(0, where, level);
  const Metric metric = in.metric(0);
  if (metric.is_implicit()) return in.reach(0, where, 0);
  // At such a depth, the input's bounding box is at least this far away.
  const double depth = -level / metric.lipschitz * (1 - 1e-9);
  return intersect(in.reach(0, where.expanded(depth), 0).expanded(-depth), where);
}

// A solid whose surface is a level of its child's distance.
struct OfLevel {
  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) const {
    warn_of_implicit_distance(reader, *inputs[0], std::string(reader.node));
    return true;
  }
  Metric metric(const Inputs& in) const { return level_metric(in); }
};

struct Offset : OfLevel {
  Number distance_mm = 1;

  static Spec<Offset> spec() {
    return {"offset",
            "Grows its child by a distance, or shrinks it. Edges and corners become round when they grow.",
            {{"distance", &Offset::distance_mm,
              "Distance by which the surface moves outward; negative: inward. A formula may vary from point to point",
              required(unit::mm)}},
            one_solid,
            "offset(2) { cube(6, \"red\"); }"};
  }

  Box reach(const Inputs& in, const Box& where, double margin) const {
    return level_reach(in, where, margin + distance_mm.range(where).hi);
  }
  Field distance(const Inputs& in, const Point& p) const { return in.distance(0, p) - distance_mm(p); }

  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    return in.composition(0, p, grown(demand));
  }
  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand) const {
    return in.attribute(0, name, p, grown(demand));
  }

 private:
  // Points inside may lie outside the child.
  Demand grown(Demand demand) const {
    return distance_mm.constant() && *distance_mm.constant() <= 0 ? demand : Demand::everywhere;
  }
};

struct Shell : OfLevel {
  Number thickness = 1;
  Choice side = "inward";

  static Spec<Shell> spec() {
    return {"shell",
            "A wall along the surface of its child.",
            {{"thickness", &Shell::thickness, "Thickness of the wall", required(unit::positive_mm)},
             {"side", &Shell::side, "Position of the wall: inward of the surface, outward, or centred on it",
              one_of({"inward", "outward", "centred"})}},
            one_solid,
            "shell(1) { sphere(8, \"red\"); }"};
  }

  Box reach(const Inputs& in, const Box& where, double margin) const {
    return level_reach(in, where, margin + outward_share() * thickness.range(where).hi);
  }

  Field distance(const Inputs& in, const Point& p) const {
    const Field wall = thickness(p);
    const Field from_middle = in.distance(0, p) - wall * (outward_share() - 0.5);
    return abs(from_middle) - wall * 0.5;
  }

  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    return in.composition(0, p, grown(demand));
  }
  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand) const {
    return in.attribute(0, name, p, grown(demand));
  }

 private:
  double outward_share() const { return side == "inward" ? 0 : side == "outward" ? 1 : 0.5; }
  Demand grown(Demand demand) const { return side == "inward" ? demand : Demand::everywhere; }
};

}  // namespace

void add_offsets(Registry& registry) { registry.add<Offset, Shell>("offsets"); }

}  // namespace ombre::nodes
