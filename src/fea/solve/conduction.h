// Steady conduction of heat or electricity.
#pragma once

#include <vector>

#include "base/system/progress.h"
#include "fea/model/model.h"
#include "fea/solve/elastic.h"

namespace ombre::fea {

struct Conduction {
  std::vector<double> value;      // of nodes: degrees Celsius, or V
  std::vector<Vec3> flux;         // in the middle of each element: W/mm2, or A/mm2
  std::vector<Prescribed> flows;  // W or A that enter where values are held, in the order of the conditions
  double lost_w = 0;              // through films
  size_t iterations = 0;          // 0: solved directly
  std::optional<DirectUse> direct;
  double residual = 0;
};

// Fourier's or Ohm's law with the sections' conductivities: on bricks without a matrix, by conjugate gradients with
// multigrid; on other meshes by an assembled matrix. Films act at the nodes of their sides, by their shares of the
// area. The same bits with any number of threads. Throws Error when it does not converge or an element is inside out,
// and Cancelled.
Conduction conduct(const ModelView& model, const Conditions& conditions, const SolveOptions& options,
                   Progress* progress = nullptr, const StopFlag* stop = nullptr);

// The memory that it takes on bricks, about.
double conduct_bytes(const Bricks& bricks);

}  // namespace ombre::fea
