// Stresses of a solution where elements are integrated, and at nodes.
#pragma once

#include <array>
#include <vector>

#include "fea/solve/elastic.h"

namespace ombre::fea {

struct Stresses {
  // Von Mises' stress at the integration point of an element where it is greatest, MPa.
  std::vector<double> greatest_at_points_mpa;
  // Of nodes, xx, yy, zz, xy, yz, zx: stresses at integration points are carried on linearly to an element's corners,
  // and corners averaged over the elements around that are of one section, by their volume. Where sections meet, that
  // of the greatest von Mises stress counts.
  std::vector<std::array<double, 6>> at_nodes_mpa;
};

// By the displacements. C3D4 has one point, C3D10 four; a brick has 2 x 2 x 2 in the box around what is inside of it,
// and its corners are those of that box, so that nodes beside the surface have the stress on it.
Stresses stresses_of(const ModelView& model, const Solution& solution);

}  // namespace ombre::fea
