// Steady conduction of heat or electricity.
#pragma once

#include <vector>

#include "base/system/progress.h"
#include "fea/model/model.h"
#include "fea/solve/elastic.h"

namespace ombre::fea {

struct Conduction {
  std::vector<double> value;      // at nodes: degrees Celsius, or V
  std::vector<Vec3> flux;         // in the middle of each element: W/mm2, or A/mm2
  std::vector<Prescribed> flows;  // W or A that enter at prescribed values, in the order of the conditions
  double lost_w = 0;              // heat that leaves through films
  size_t iterations = 0;          // 0: solved directly
  std::optional<DirectUse> direct;
  double residual = 0;
};

// Solves Fourier's or Ohm's law with the sections' conductivities: on bricks without a matrix, by conjugate gradients
// with multigrid; on other meshes by an assembled matrix. Films act at the nodes of their sides, by their shares of the
// area. The result has the same bits with any number of threads. Throws Error when it does not converge or an element
// is inverted, and Cancelled.
Conduction conduct(const ModelView& model, const Conditions& conditions, const SolveOptions& options,
                   Progress* progress = nullptr, const StopFlag* stop = nullptr);

// Returns about the memory in bytes that it takes on bricks.
double conduct_bytes(const Bricks& bricks);

}  // namespace ombre::fea
