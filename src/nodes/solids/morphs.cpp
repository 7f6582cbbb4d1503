// Solids that turn into one another in space.
#include "design/spec.h"
#include "nodes/common/field_math.h"
#include "nodes/common/mixtures.h"

namespace ombre::nodes {
namespace {

using namespace design;

// Mixes its children by weights that change in space. With the shares s of the weights' sum, and the children's
// distances d, the mixture's g is the sum of s * d: for struts that is the mean distance from their axes less the mean
// radius. The weights of seeds are Shepard's (1968): distances to the seeds to a negative power.
struct Morph {
  SharedList<Number> weight;
  Choice mode = "blend";
  Points seeds;
  double power = 2;
  std::vector<NamedWord> attribute_words;

  static Spec<Morph> spec() {
    return {
        "morph",
        "Turns its children into one another in space, such as the cells of one lattice into those of another.",
        {{"weight", &Morph::weight,
          "Share of the second of two children, from 0 to 1; or a list with the weight of each child, 0 or more. Where "
          "all weights are 0, there is nothing"},
         {"mode", &Morph::mode,
          "blend: distances from surfaces are mixed by the weights; sharp: the child with the greatest weight is "
          "alone; "
          "overlap: all children with a weight above 0 are there",
          one_of({"blend", "sharp", "overlap"})},
         {"seeds", &Morph::seeds,
          "In place of weights: a point for each child, whose weight falls with the distance from it", unit::points},
         {"power", &Morph::power, "Power of the distance with which weights of seeds fall", from_to(0.5, 16)},
         {"attributes", &Morph::attribute_words, attribute_rules_doc, attribute_rules()}},
        {2, many_solids.most, true, OfNothing::counts},
        "m = box_cells((5, 5, 5), min=(0, 0, 0), max=(20, 10, 10)); morph(clamp(0, m.place.x - 1.5, 1)) { "
        "lattice(\"bcc\", radius=0.6, material=\"red\", map=m); lattice(\"cubic\", radius=0.8, material=\"blue\", "
        "map=m); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) const {
    const size_t count = inputs.size();
    if (weight.empty() == seeds.at.empty())
      return reader.refuse(weight.empty() ? "morph has neither weights nor seeds" : "morph has both weights and seeds",
                           "write for example " + spelled::call("morph", {{"weight", "0.5"}}) + ", or " +
                               spelled::call("morph", {{"seeds", "[(0, 0, 0), (10, 0, 0)]"}}));
    if (!seeds.at.empty()) return has_one_for_each(reader, seeds.at.size(), count, "seeds") && fits_seeds(reader);
    if (weight.size() == 1 && count == 2) return true;
    return has_one_for_each(reader, weight.size(), count, "weights") && has_some_weight(reader);
  }

  Metric metric(const Inputs& in) const {
    const auto is_constant = [](const Number& w) { return w.constant() != nullptr; };
    if (!seeds.at.empty() || !std::ranges::all_of(weight.items(), is_constant)) return Metric::implicit();
    Metric metric = Metric::bounded();
    for (size_t i = 0; i < in.count(); ++i) metric = weaker(metric, in.metric(i));
    return metric;
  }

  // A mean of distances is at least the least of them.
  Box reach(const Inputs& in, const Box& where, double margin) const {
    Box box;
    for (size_t i = 0; i < in.count(); ++i)
      if (may_count(i, in.count(), where)) box = hull(box, in.reach(i, where, margin));
    return box;
  }

  Field distance(const Inputs& in, const Point& p) const {
    const std::vector<Field> shares = shares_of(p), distances = in.distances(p);
    if (mode == "blend") return alone_or(shares, distances, mean(shares, distances));
    Field least = nowhere(p);
    for (size_t i = 0; i < shares.size(); ++i) least = min(least, select(truth(shares[i]), distances[i], nowhere(p)));
    return least;
  }

  // Where one child is alone, its own membership counts, so that nothing of it changes.
  Field membership(const Inputs& in, const Point& p, Border border) const {
    const std::vector<Field> shares = shares_of(p), flags = in.memberships(p, border);
    if (mode == "blend") return alone_or(shares, flags, at_most(mean(shares, in.distances(p)), 0, border));
    return program::fold(counted(shares, flags), program::logical_or);
  }

  Composition composition(const Inputs& in, const Point& p, Demand) const {
    Composition made = weighted(in, p, Demand::everywhere, materials_by(in, p));
    if (const auto check = check_of_weights(in, p)) made.checks.push_back(*check);
    return made;
  }

  // Numbers are mixed as materials are, unless a rule says otherwise.
  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand) const {
    AttributeDeclaration declared = in.declaration(name);
    declared.overlap = Overlap::mix;
    return overlapping_attribute(in, name, p, Demand::everywhere, materials_by(in, p),
                                 in_place_of(declared, attribute_words));
  }

 private:
  static bool has_one_for_each(const Reader& reader, size_t found, size_t count, std::string_view what) {
    return found == count || reader.refuse("morph has " + std::to_string(found) + " " + std::string(what) + " for " +
                                               std::to_string(count) + " children",
                                           "give one for each");
  }
  bool fits_seeds(const Reader& reader) const {
    return !(mode == "overlap") || reader.refuse(
                                       "the weights of seeds are above 0 everywhere, so that all children "
                                       "would overlap everywhere",
                                       "write " + spelled::parameter("mode", "\"sharp\"") + ", or weights that end");
  }
  bool has_some_weight(const Reader& reader) const {
    const auto is_none = [](const Number& w) { return w.constant() && *w.constant() <= 0; };
    return !std::ranges::all_of(weight.items(), is_none) ||
           reader.refuse("all weights of morph are 0", "give one above 0");
  }

  // Returns a check of weights that are not finite, such as 0/0. Numbers of the script are known to be finite.
  std::optional<std::pair<uint32_t, Field>> check_of_weights(const Inputs& in, const Point& p) const {
    std::vector<Field> bad;
    for (const Number& w : weight)
      if (!w.constant()) bad.push_back(logical_not(is_finite(w(p))));
    if (bad.empty()) return std::nullopt;
    const Field any = program::fold(bad, program::logical_or);
    if (p.builder().constant_value(any) == 0.0) return std::nullopt;
    return in.check(any, "a weight of morph is not finite, so that its children are not mixed as they should be");
  }

  bool is_single() const { return weight.size() == 1; }
  // Returns false if the child's weight is 0 in all of the box.
  bool may_count(size_t i, size_t count, const Box& where) const {
    if (!seeds.at.empty() || where.is_empty()) return true;
    const Interval of = weight.items()[is_single() ? 0 : i].range(where);
    return is_single() && count == 2 && i == 0 ? !(of.lo >= 1) : !(of.hi <= 0);
  }

  // Larger than the distance between any two points of a design.
  static Field nowhere(const Point& p) { return p.constant(10 * design_limit_mm); }

  std::vector<Field> weights_of(const Point& p) const {
    if (!seeds.at.empty()) return weights_of_seeds(p);
    if (is_single()) {
      const Field t = limited(weight.items()[0](p), 0, 1);
      return {1 - t, t};
    }
    std::vector<Field> weights;
    for (const Number& w : weight) weights.push_back(max(w(p), 0.0));
    return weights;
  }

  // Weights are relative to that of the nearest seed, which is 1, so that they are finite at seeds, too.
  std::vector<Field> weights_of_seeds(const Point& p) const {
    constexpr double least_distance = 1e-9;
    std::vector<Field> distances;
    for (const Vec3 seed : seeds.at)
      distances.push_back(max(length(p.x - seed.x, p.y - seed.y, p.z - seed.z), least_distance));
    const Field least = program::fold(distances, program::min);
    std::vector<Field> weights;
    for (const Field distance : distances) weights.push_back(power_of(least / distance, power));
    return weights;
  }

  // Returns weights whose sum is 1, or 0 where there is nothing. In the mode "sharp" one of them is 1.
  std::vector<Field> shares_of(const Point& p) const {
    std::vector<Field> weights = weights_of(p);
    if (mode == "sharp") return greatest(weights, p);
    if (is_single()) return weights;
    const Field total = program::sum(weights);
    for (Field& w : weights) w = select(truth(w), w / total, p.constant(0));
    return weights;
  }

  static std::vector<Field> greatest(const std::vector<Field>& weights, const Point& p) {
    const Field most = program::fold(weights, static_cast<Field (*)(Field, Field)>(program::max));
    std::vector<Field> flags;
    for (const Field w : weights) flags.push_back(logical_and(less_equal(most, w), less(p.constant(0), w)));
    return first_true(flags);
  }

  static std::vector<Field> counted(const std::vector<Field>& shares, const std::vector<Field>& flags) {
    std::vector<Field> found;
    for (size_t i = 0; i < shares.size(); ++i) found.push_back(logical_and(truth(shares[i]), flags[i]));
    return found;
  }

  // Children without weight do not count, whatever their distances are.
  static Field mean(const std::vector<Field>& shares, const std::vector<Field>& distances) {
    const Field zero = shares[0].builder->constant(0);
    std::vector<Field> terms, flags;
    for (size_t i = 0; i < shares.size(); ++i) {
      flags.push_back(truth(shares[i]));
      terms.push_back(select(flags.back(), shares[i] * distances[i], zero));
    }
    return select(program::fold(flags, program::logical_or), program::sum(terms),
                  zero.builder->constant(10 * design_limit_mm));
  }

  // Returns the value of the child whose share is 1, or else the other value.
  static Field alone_or(const std::vector<Field>& shares, const std::vector<Field>& values, Field otherwise) {
    for (size_t i = shares.size(); i-- > 0;)
      otherwise = select(less_equal(shares[i].builder->constant(1), shares[i]), values[i], otherwise);
    return otherwise;
  }

  // Returns the weights of the children's materials: the shares; where children overlap, of those that hold the point.
  // Where none of them counts, all children with points do.
  std::vector<Field> materials_by(const Inputs& in, const Point& p) const {
    std::vector<Field> shares = shares_of(p);
    if (mode == "overlap") shares = of_holders(shares, in.memberships(p, Border::included));
    const Field zero = p.constant(0), one = p.constant(1);
    std::vector<Field> flags;
    for (size_t i = 0; i < shares.size(); ++i) {
      if (in.input(i).is_nothing()) shares[i] = zero;
      flags.push_back(truth(shares[i]));
    }
    const Field any = program::fold(flags, program::logical_or);
    for (size_t i = 0; i < shares.size(); ++i)
      if (!in.input(i).is_nothing()) shares[i] = select(any, shares[i], one);
    return shares;
  }

  static std::vector<Field> of_holders(std::vector<Field> shares, const std::vector<Field>& memberships) {
    const std::vector<Field> held = counted(shares, memberships);
    const Field any = program::fold(held, program::logical_or), zero = any.builder->constant(0);
    for (size_t i = 0; i < shares.size(); ++i)
      shares[i] = select(logical_or(held[i], logical_not(any)), shares[i], zero);
    return shares;
  }
};

}  // namespace

void add_morphs(Registry& registry) { registry.add<Morph>("booleans"); }

}  // namespace ombre::nodes
