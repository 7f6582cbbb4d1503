// Compositions and attributes where several solids overlap or blend.
#pragma once

#include <map>

#include "design/node.h"

namespace ombre::nodes {

// A parameter of nodes that combine attributes: rules that count in place of the attributes' own.
inline constexpr std::string_view attribute_rules_doc =
    "Rules for attributes where children overlap, in place of the attributes' own: [[\"modulus\", \"max\"]]";
design::Domain attribute_rules();
// Returns the declaration with the rule that a node gives for this attribute, if it gives one.
design::AttributeDeclaration in_place_of(design::AttributeDeclaration declaration,
                                         const std::vector<design::NamedWord>& rules);

// Returns the weighted mean of the inputs' compositions. Weights must not be negative, nor all zero where the result
// matters. An input with weight zero has no effect, whatever its composition.
design::Composition weighted(const design::Inputs& in, const program::Point& p, design::Demand demand,
                             const std::vector<program::Field>& weights);

// Returns the weighted mean of given compositions, one for each weight.
design::Composition weighted(const std::vector<design::Composition>& parts, const std::vector<program::Field>& weights);

// Sums compositions with weights, and divides by the total weight.
class WeighedSums {
 public:
  // Starts with the sums of a table: fractions times weights with their checks, and the sum of the weights.
  WeighedSums(const design::Composition& sums, program::Field total);
  void add(const design::Composition& composition, program::Field weight);
  design::Composition shares() const;

 private:
  program::Field total_;
  std::map<MaterialId, program::Field> fractions_;
  std::map<uint32_t, program::Field> checks_;
};

// Returns the mean of all inputs that hold the point, if most of them are rows of a table.
design::Composition mixed(const design::Inputs& in, const program::Point& p, const design::PartFields& parts);

// Returns truth values that mark the input with the least distance, the first one in a tie.
std::vector<program::Field> nearest(const std::vector<program::Field>& distances);
// Keeps only the first, or the last, of several truth values that is true.
std::vector<program::Field> first_true(const std::vector<program::Field>& flags);
std::vector<program::Field> last_true(const std::vector<program::Field>& flags);

// Combines the attribute's values of the inputs that contain the point, by its overlap rule. Returns its default where
// no input that has it contains the point.
program::Field overlapping_attribute(const design::Inputs& in, std::string_view name, const program::Point& p,
                                     design::Demand demand, const std::vector<program::Field>& insides,
                                     const design::AttributeDeclaration& declaration);

// Combines given values by an overlap rule. Only values whose weight is not 0 count; the size of the weight matters
// only to the rule `mix`.
program::Field overlapping_values(const std::vector<program::Field>& values, const std::vector<program::Field>& weights,
                                  design::Overlap overlap, program::Field otherwise);

}  // namespace ombre::nodes
