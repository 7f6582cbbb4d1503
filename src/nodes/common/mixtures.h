// Compositions and attributes where several solids meet.
#pragma once

#include <map>

#include "design/node.h"

namespace ombre::nodes {

// The inputs' compositions, each counted with its weight (not negative, not all zero where it matters);
// a weight of zero hides whatever the input's composition is there.
design::Composition weighted(const design::Inputs& in, const program::Point& p, design::Demand demand,
                             const std::vector<program::Field>& weights);

// The same of compositions that are at hand, one for each weight.
design::Composition weighted(const std::vector<design::Composition>& parts, const std::vector<program::Field>& weights);

// Sums of compositions by weights, and their shares of the total.
class WeighedSums {
 public:
  // Begins with what a table has summed: fractions times weights, checks where they are 1, and the sum of the weights.
  WeighedSums(const design::Composition& sums, program::Field total);
  void add(const design::Composition& composition, program::Field weight);
  design::Composition shares() const;

 private:
  program::Field total_;
  std::map<MaterialId, program::Field> fractions_;
  std::map<uint32_t, program::Field> checks_;
};

// The mean of all inputs that hold the point, when most of them are rows of a table.
design::Composition mixed(const design::Inputs& in, const program::Point& p, const design::PartFields& parts);

// Truth values: is this input's distance the least, the first on ties?
std::vector<program::Field> nearest(const std::vector<program::Field>& distances);
// Keeps of several truth values only the first that is true (or the last).
std::vector<program::Field> first_true(const std::vector<program::Field>& flags);
std::vector<program::Field> last_true(const std::vector<program::Field>& flags);

// What the inputs that contain the point say of the attribute, by its overlap rule; its default where
// none that has it contains the point.
program::Field overlapping_attribute(const design::Inputs& in, std::string_view name, const program::Point& p,
                                     design::Demand demand, const std::vector<program::Field>& insides,
                                     const design::AttributeDeclaration& declaration);

// The same of values that are at hand, of which those count whose weight is not 0. How large it is matters to the rule
// `mix` alone.
program::Field overlapping_values(const std::vector<program::Field>& values, const std::vector<program::Field>& weights,
                                  design::Overlap overlap, program::Field otherwise);

}  // namespace ombre::nodes
