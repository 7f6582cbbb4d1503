// Linear elasticity on meshes of tetrahedra or hexahedra.
#pragma once

#include "fea/solve/elastic.h"

namespace ombre::fea {

// Solves by an assembled matrix (node_matrix.h). C3D4 has constant strains: it is stiff in bending, and locks if
// Poisson's ratio is near 0.5. C3D10 is integrated at four points, which is good up to 0.49. C3D8 has the mean change
// of volume, like bricks. Stresses are those in the middle of each element. The result has the same bits with any
// number of threads. Throws Error when it does not converge or an element is inverted, and Cancelled.
Solution solve_mesh(const ModelView& model, const Conditions& conditions, const SolveOptions& options,
                    Progress* progress = nullptr, const StopFlag* stop = nullptr);

// Poisson's ratio above which C3D4 is too stiff to be trusted.
inline constexpr double most_poissons_ratio_of_c3d4 = 0.45;

}  // namespace ombre::fea
