#include "nodes/common/mixtures.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace ombre::nodes {

using design::Composition;
using design::Demand;
using design::Inputs;
using program::Field;
using program::Point;

namespace {

// True if all inputs consist of the same single material everywhere and have no checks.
bool is_one_material(const std::vector<Composition>& parts) {
  for (const Composition& part : parts)
    if (part.fractions.size() != 1 || !part.checks.empty() || part.fractions[0].first != parts[0].fractions[0].first)
      return false;
  return true;
}

}  // namespace

design::Domain attribute_rules() {
  return design::one_of({design::overlap_names.begin(), design::overlap_names.end()});
}

design::AttributeDeclaration in_place_of(design::AttributeDeclaration declaration,
                                         const std::vector<design::NamedWord>& rules) {
  for (const design::NamedWord& rule : rules)
    if (rule.name == declaration.name) declaration.overlap = design::overlap_called(rule.word);
  return declaration;
}

Composition weighted(const Inputs& in, const Point& p, Demand demand, const std::vector<Field>& weights) {
  std::vector<Composition> parts;
  for (size_t i = 0; i < in.count(); ++i) parts.push_back(in.composition(i, p, demand));
  return weighted(parts, weights);
}

Composition weighted(const std::vector<Composition>& parts, const std::vector<Field>& weights) {
  if (is_one_material(parts)) return parts[0];

  const Field zero = weights[0].builder->constant(0);
  std::map<MaterialId, std::vector<Field>> terms;
  std::map<uint32_t, std::vector<Field>> flags;
  for (size_t i = 0; i < parts.size(); ++i) {
    // Uses select instead of a product, since the values of a hidden input may be NaN.
    for (const auto& [id, fraction] : parts[i].fractions)
      terms[id].push_back(select(truth(weights[i]), fraction * weights[i], zero));
    for (const auto& [number, flag] : parts[i].checks) flags[number].push_back(logical_and(truth(weights[i]), flag));
  }
  const Field total = program::sum(weights);
  Composition result;
  for (auto& [id, list] : terms) result.fractions.emplace_back(id, share(program::sum(std::move(list)), total));
  for (auto& [number, list] : flags)
    result.checks.emplace_back(number, program::fold(std::move(list), program::logical_or));
  return result;
}

WeighedSums::WeighedSums(const Composition& sums, Field total) : total_(total) {
  for (const auto& [id, sum] : sums.fractions) fractions_[id] = sum;
  for (const auto& [number, flag] : sums.checks) checks_[number] = flag;
}

void WeighedSums::add(const Composition& composition, Field weight) {
  const Field zero = weight.builder->constant(0), counts = truth(weight);
  const bool is_flag = weight.builder->is_truth(weight);
  total_ = total_ + weight;
  for (const auto& [id, fraction] : composition.fractions) {
    const Field term = select(counts, is_flag ? fraction : fraction * weight, zero);
    Field& sum = fractions_[id];
    sum = sum ? sum + term : term;
  }
  for (const auto& [number, flag] : composition.checks) {
    const Field bad = logical_and(counts, flag);
    Field& known = checks_[number];
    known = known ? logical_or(known, bad) : bad;
  }
}

Composition WeighedSums::shares() const {
  Composition result;
  for (const auto& [id, sum] : fractions_) result.fractions.emplace_back(id, share(sum, total_));
  for (const auto& check : checks_) result.checks.push_back(check);
  return result;
}

Composition mixed(const design::Inputs& in, const Point& p, const design::PartFields& parts) {
  std::vector<Composition> others;
  for (const size_t i : parts.others) others.push_back(in.composition(i, p, Demand::inside));
  if (parts.only) {
    others.push_back(Composition::pure(*parts.only, p.constant(1)));
    if (is_one_material(others)) return others.back();
    others.pop_back();
  }

  WeighedSums sums(parts.composition, parts.count);
  for (size_t n = 0; n < others.size(); ++n) sums.add(others[n], in.inside(parts.others[n], p));
  return sums.shares();
}

std::vector<Field> first_true(const std::vector<Field>& flags) {
  std::vector<Field> result;
  Field before = flags[0].builder->constant(0);
  for (const Field flag : flags) {
    result.push_back(logical_and(flag, logical_not(before)));
    before = logical_or(before, flag);
  }
  return result;
}

std::vector<Field> last_true(const std::vector<Field>& flags) {
  std::vector<Field> result = first_true({flags.rbegin(), flags.rend()});
  return {result.rbegin(), result.rend()};
}

std::vector<Field> nearest(const std::vector<Field>& distances) {
  const Field least = program::fold(distances, program::min);
  std::vector<Field> flags;
  for (const Field distance : distances) flags.push_back(less_equal(distance, least));
  return first_true(flags);
}

Field overlapping_attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand,
                            const std::vector<Field>& insides, const design::AttributeDeclaration& declaration) {
  std::vector<Field> flags, values;
  for (size_t i = 0; i < in.count(); ++i) {
    if (!in.has_attribute(i, name)) continue;
    flags.push_back(insides[i]);
    values.push_back(in.attribute(i, name, p, demand));
  }
  const Field otherwise = p.constant(default_of(declaration, name));
  return values.empty() ? otherwise : overlapping_values(values, flags, declaration.overlap, otherwise);
}

namespace {

// Returns the weighted mean. Values with weight 0 do not count.
Field weighed_mean(const std::vector<Field>& values, const std::vector<Field>& weights, Field zero) {
  std::vector<Field> terms;
  for (size_t i = 0; i < values.size(); ++i) {
    const bool is_flag = zero.builder->is_truth(weights[i]);
    terms.push_back(select(truth(weights[i]), is_flag ? values[i] : values[i] * weights[i], zero));
  }
  return program::sum(terms) / program::sum(weights);
}

// Returns the least or greatest of the values whose flag is set. `beyond` replaces the others.
Field extreme(const std::vector<Field>& values, const std::vector<Field>& flags, double beyond,
              Field (*combine)(Field, Field)) {
  std::vector<Field> present;
  for (size_t i = 0; i < values.size(); ++i)
    present.push_back(select(flags[i], values[i], values[i].builder->constant(beyond)));
  return program::fold(present, combine);
}

Field combined(const std::vector<Field>& values, const std::vector<Field>& weights, design::Overlap overlap,
               Field zero) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<Field> flags;
  for (const Field weight : weights) flags.push_back(truth(weight));
  const auto total = [&](const std::vector<Field>& counted) {
    std::vector<Field> terms;
    std::ranges::transform(values, counted, std::back_inserter(terms),
                           [&](const Field& value, const Field& flag) { return select(flag, value, zero); });
    return program::sum(terms);
  };
  switch (overlap) {
    case design::Overlap::first:
      return total(first_true(flags));
    case design::Overlap::last:
      return total(last_true(flags));
    case design::Overlap::sum:
      return total(flags);
    case design::Overlap::mean:
      return total(flags) / program::sum(flags);
    case design::Overlap::mix:
      return weighed_mean(values, weights, zero);
    case design::Overlap::min:
      return extreme(values, flags, infinity, program::min);
    case design::Overlap::max:
      return extreme(values, flags, -infinity, program::max);
  }
  return zero;
}

}  // namespace

Field overlapping_values(const std::vector<Field>& values, const std::vector<Field>& weights, design::Overlap overlap,
                         Field otherwise) {
  std::vector<Field> flags;
  for (const Field weight : weights) flags.push_back(truth(weight));
  const Field any = program::fold(flags, program::logical_or), zero = otherwise.builder->constant(0);
  return select(any, combined(values, weights, overlap, zero), otherwise);
}

}  // namespace ombre::nodes
