// Stresses of a solution at integration points and at nodes.
#pragma once

#include <array>
#include <vector>

#include "fea/solve/elastic.h"

namespace ombre::fea {

struct Stresses {
  // Greatest von Mises stress at the integration points of each element, MPa.
  std::vector<double> greatest_at_points_mpa;
  // Stresses at nodes: xx, yy, zz, xy, yz, zx. They are extrapolated linearly from integration points to an element's
  // corners, and averaged by volume over the elements around that have one section. Where sections meet, that with the
  // greatest von Mises stress counts.
  std::vector<std::array<double, 6>> at_nodes_mpa;
};

// Computes stresses from the displacements. C3D4 has one point, C3D10 four. A brick has 2 x 2 x 2 in the box around its
// part inside. Its corners are those of that box, so nodes beside the surface have the stress on it.
Stresses stresses_of(const ModelView& model, const Solution& solution);

}  // namespace ombre::fea
