// Solids joined with fillets or chamfers.
//
// Each solid has an influence up to a radius k beyond its surface: w = max(k - d, 0). If m is the least distance, the
// joint is one of these:
// - max(k, m) - sqrt(sum of w^2), a fillet of radius k between perpendicular faces.
// - max(k, m) - sum of w, a chamfer that begins k away from the corner.
//
// A single solid is not changed, solids farther than k have no effect, and the order does not matter.
#pragma once

#include "design/node.h"

namespace ombre::nodes {

struct Blend {
  const design::Number& radius;
  bool is_chamfer = false;

  bool is_plain() const { return radius.constant() && *radius.constant() == 0; }
  design::Falloff falloff() const;
  // Returns the joint's distance. `total` is the sum of the solids' weights, `least` the least distance.
  program::Field distance(program::Field total, program::Field least, const program::Point& p) const;
  // True if a point is in the joint. `any` is true if the point is in one of the solids, with the same border.
  program::Field membership(program::Field total, program::Field any, const program::Point& p,
                            design::Border border) const;
  // Returns the Lipschitz constant of the joint of distances whose own constant is 1.
  double lipschitz(size_t solids) const;
  // Returns the greatest distance of an input at points where the joint of `solids` has g of at most `margin`.
  double reach(size_t solids, const Box& where, double margin) const;

 private:
  program::Field full(const program::Point& p) const;  // the weight at a surface
};

// Returns the weights of all inputs.
std::vector<program::Field> weights(const design::Inputs& in, const program::Point& p, const design::Falloff& falloff);
// The sum of all weights, and whether an input (or its interior) holds the point. Taken from a table if there are many
// inputs.
struct Influence {
  program::Field total, any;
};
Influence influence_of(const design::Inputs& in, const program::Point& p, design::PartQuery query,
                       const design::Falloff& falloff);

// Returns the composition of blended solids. Inputs that hold the point count by the rule (mix, first, last). If none
// does, all count by their weights, and where these are 0 the nearest counts. With the rule "blend", weights always
// count.
design::Composition blended_composition(const design::Inputs& in, const program::Point& p, design::Demand demand,
                                        std::string_view rule, const design::Falloff& falloff);
program::Field blended_attribute(const design::Inputs& in, std::string_view name, const program::Point& p,
                                 design::Demand demand, const design::Falloff& falloff,
                                 const design::AttributeDeclaration& declaration);

}  // namespace ombre::nodes
