#include "nodes/solids/blends.h"

#include <cmath>
#include <map>

#include "nodes/common/mixtures.h"

namespace ombre::nodes {

using design::Border;
using design::Composition;
using design::Demand;
using design::Falloff;
using design::Inputs;
using design::PartFields;
using design::PartQuery;
using program::Field;
using program::Point;

namespace {

PartQuery query_for(std::string_view rule) {
  return rule == "first" ? PartQuery::first : rule == "last" ? PartQuery::last : PartQuery::mix;
}

// Returns the share of each input, by the rule.
std::vector<Field> shares(const Inputs& in, const Point& p, Demand demand, std::string_view rule,
                          const Falloff& falloff) {
  std::vector<Field> result = weights(in, p, falloff);
  if (demand == Demand::everywhere) {
    const Field reached = less(p.constant(0), program::sum(result));
    const std::vector<Field> close = nearest(in.distances(p));
    for (size_t i = 0; i < result.size(); ++i) result[i] = select(reached, result[i], close[i]);
  }
  if (rule == "blend") return result;
  std::vector<Field> flags = in.memberships(p, Border::included);
  const Field any = program::fold(flags, program::logical_or);
  if (rule == "first") flags = first_true(flags);
  if (rule == "last") flags = last_true(flags);
  for (size_t i = 0; i < result.size(); ++i) result[i] = select(any, flags[i], result[i]);
  return result;
}

// Returns `yes` where the condition is true, else `no`.
Composition choose(Field condition, const Composition& yes, const Composition& no) {
  const Field zero = condition.builder->constant(0);
  std::map<MaterialId, std::pair<Field, Field>> fractions;
  for (const auto& [id, fraction] : yes.fractions) fractions[id] = {fraction, zero};
  for (const auto& [id, fraction] : no.fractions) {
    const auto [it, is_new] = fractions.try_emplace(id, zero, fraction);
    if (!is_new) it->second.second = fraction;
  }
  Composition result;
  for (const auto& [id, pair] : fractions)
    result.fractions.emplace_back(id, select(condition, pair.first, pair.second));
  for (const auto& [number, flag] : yes.checks) result.checks.emplace_back(number, logical_and(condition, flag));
  for (const auto& [number, flag] : no.checks)
    result.checks.emplace_back(number, logical_and(logical_not(condition), flag));
  return result;
}

bool all_of_one(const Inputs& in, const Point& p, const PartFields& parts) {
  if (!parts.only) return false;
  for (const size_t i : parts.others) {
    const Composition other = in.composition(i, p, Demand::everywhere);
    if (other.fractions.size() != 1 || other.fractions[0].first != *parts.only || !other.checks.empty()) return false;
  }
  return true;
}

Composition from_table(const Inputs& in, const Point& p, std::string_view rule, const Falloff& falloff,
                       const PartFields& parts) {
  if (all_of_one(in, p, parts)) return Composition::pure(*parts.only, p.constant(1));
  WeighedSums weighed(parts.weighed, parts.weight);
  WeighedSums held(rule == "mix" ? parts.composition : Composition{}, rule == "mix" ? parts.count : p.constant(0));
  Field any = parts.inside;
  for (const size_t i : parts.others) {
    const Composition other = in.composition(i, p, Demand::everywhere);
    const Field inside = in.inside(i, p);
    weighed.add(other, falloff.weight(in.distance(i, p), p));
    held.add(other, inside);
    any = logical_or(any, inside);
  }
  if (rule == "blend") return weighed.shares();
  return choose(any, rule == "mix" ? held.shares() : parts.composition, weighed.shares());
}

}  // namespace

Field Blend::full(const Point& p) const { return is_chamfer ? radius(p) : square(radius(p)); }

Falloff Blend::falloff() const {
  const auto weight = [blend = *this](Field distance, const Point& p) {
    const Field depth = max(blend.radius(p) - distance, 0.0);
    return blend.is_chamfer ? depth : square(depth);
  };
  return {weight, radius.range(design::design_space()).hi};
}

Field Blend::distance(Field total, Field least, const Point& p) const {
  return max(radius(p), least) - (is_chamfer ? total : sqrt(total));
}

Field Blend::membership(Field total, Field any, const Point& p, Border border) const {
  const Field held = at_most(full(p), total, border);
  if (radius.constant()) return held;
  // A radius of 0 joins nothing, although 0 <= 0 would hold everywhere.
  return logical_or(any, border == Border::excluded ? held : logical_and(held, less(p.constant(0), radius(p))));
}

double Blend::lipschitz(size_t solids) const {
  const auto n = static_cast<double>(solids);
  return is_chamfer ? n : std::sqrt(n);
}

// If `solids` of them have a distance of at least D, with D below k, the joint's g is at least k - (k - D) *
// lipschitz(solids).
double Blend::reach(size_t solids, const Box& where, double margin) const {
  const Interval k = radius.range(where);
  const double least = k.hi - (k.hi - margin) / lipschitz(solids);
  return margin >= k.hi ? margin : radius.constant() ? least : k.hi;
}

std::vector<Field> weights(const Inputs& in, const Point& p, const Falloff& falloff) {
  std::vector<Field> result;
  for (const Field distance : in.distances(p)) result.push_back(falloff.weight(distance, p));
  return result;
}

Influence influence_of(const Inputs& in, const Point& p, PartQuery query, const Falloff& falloff) {
  const Border border = query == PartQuery::interior ? Border::excluded : Border::included;
  const auto parts = in.many_parts(query, p, &falloff);
  if (!parts)
    return {program::sum(weights(in, p, falloff)), program::fold(in.memberships(p, border), program::logical_or)};
  Influence sum{parts->weight, parts->inside};
  for (const size_t i : parts->others) {
    sum.total = sum.total + falloff.weight(in.distance(i, p), p);
    sum.any = logical_or(sum.any, in.membership(i, p, border));
  }
  return sum;
}

Composition blended_composition(const Inputs& in, const Point& p, Demand demand, std::string_view rule,
                                const Falloff& falloff) {
  if (in.count() == 1) return in.composition(0, p, demand);
  const auto parts = demand == Demand::inside ? in.many_parts(query_for(rule), p, &falloff) : std::nullopt;
  const bool in_order = rule == "first" || rule == "last";
  if (parts && (!in_order || parts->others.empty())) return from_table(in, p, rule, falloff, *parts);
  return weighted(in, p, Demand::everywhere, shares(in, p, demand, rule, falloff));
}

Field blended_attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand, const Falloff& falloff,
                        const design::AttributeDeclaration& declaration) {
  if (in.count() == 1) return in.attribute(0, name, p, demand);
  const bool weighs = declaration.overlap == design::Overlap::mix;
  std::vector<Field> flags;
  for (const Field share : shares(in, p, demand, weighs ? "blend" : "mix", falloff))
    flags.push_back(weighs ? share : truth(share));
  return overlapping_attribute(in, name, p, Demand::everywhere, flags, declaration);
}

}  // namespace ombre::nodes
