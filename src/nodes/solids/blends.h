// Solids joined with fillets or chamfers.
//
// Each solid has an influence up to a radius k beyond its surface: w = max(k - d, 0). With m the least distance, the
// joint is
//   max(k, m) - sqrt(sum of w^2)    a fillet of radius k between faces at a right angle, or
//   max(k, m) - sum of w            a chamfer that begins k away from the corner.
// One solid alone stays as it is, what is farther than k adds exactly nothing, and the order does not matter.
#pragma once

#include "design/node.h"

namespace ombre::nodes {

struct Blend {
  const design::Number& radius;
  bool is_chamfer = false;

  bool is_plain() const { return radius.constant() && *radius.constant() == 0; }
  design::Falloff falloff() const;
  // From the solids' weights, of which `total` is the sum, and the least distance.
  program::Field distance(program::Field total, program::Field least, const program::Point& p) const;
  // Whether a point is in the joint; `any`: in one of the solids, with the same border.
  program::Field membership(program::Field total, program::Field any, const program::Point& p,
                            design::Border border) const;
  // Of distances that change at most once as fast as the point moves.
  double lipschitz(size_t solids) const;
  // How far an input may be where the joint of `solids` is `margin` away or less.
  double reach(size_t solids, const Box& where, double margin) const;

 private:
  program::Field full(const program::Point& p) const;  // the weight on a surface
};

// The weights of all inputs.
std::vector<program::Field> weights(const design::Inputs& in, const program::Point& p, const design::Falloff& falloff);
// Their sum, and whether an input holds the point (or its interior does); by a table if there are many.
struct Influence {
  program::Field total, any;
};
Influence influence_of(const design::Inputs& in, const program::Point& p, design::PartQuery query,
                       const design::Falloff& falloff);

// Composition where solids have an influence beyond their surfaces. Inputs that hold the point count by the rule (mix,
// first, last); if none does, all by their weights, and where these are 0 the nearest. With "blend", always by weights.
design::Composition blended_composition(const design::Inputs& in, const program::Point& p, design::Demand demand,
                                        std::string_view rule, const design::Falloff& falloff);
program::Field blended_attribute(const design::Inputs& in, std::string_view name, const program::Point& p,
                                 design::Demand demand, const design::Falloff& falloff,
                                 const design::AttributeDeclaration& declaration);

}  // namespace ombre::nodes
