// Sparse matrices over the nodes of a mesh, assembled from elements; and the solution of their systems.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/system/progress.h"
#include "fea/model/element_points.h"

namespace ombre::fea {

// What one element adds between two of its nodes: of their unknowns, row by row; of one unknown, the first number.
using NodeBlock = std::array<double, 9>;
// Adds the blocks between node `a` of the element and each of its nodes. Called from several threads.
using ElementRow =
    std::function<void(size_t element, const ElementPoints& points, size_t a, std::array<NodeBlock, 10>& blocks)>;

struct LinearSystem {
  MeshView mesh;
  size_t unknowns = 3;  // of each node
  ElementRow row;
  std::vector<uint8_t> free;          // of each unknown; the others are held
  std::vector<double> more_diagonal;  // added to it, if there is any
  int threads = 0;
};

// The elements' rows times `x`, without a matrix; and what is added to the diagonal.
std::vector<double> product(const LinearSystem& system, const std::vector<double>& x);

struct LinearOptions {
  double tolerance = 1e-8;  // of the residual, in the norm of the right side
  size_t most_iterations = 20000;
};
struct LinearReport {
  size_t iterations = 0;  // 0: solved directly
  double residual = 0;
};

// Finds x such that the matrix times x is `right`, for the free unknowns; held ones count as 0 and stay so. The
// matrix must be symmetric and positive definite. Few unknowns by a direct factorisation (Eigen's SimplicialLDLT), else
// by conjugate gradients with an incomplete one
// (IncompleteCholesky: Lin and More, 1999) and a coarse grid. Progress counts thousandths
// of the way to the tolerance. Throws Error when it does not converge or memory is short, and Cancelled.
std::vector<double> solve_system(const LinearSystem& system, const std::vector<double>& right,
                                 const LinearOptions& options, LinearReport& report, Progress* progress,
                                 const StopFlag* stop);

// The memory that solve_system() takes, about.
double system_bytes(const MeshView& mesh, size_t unknowns);

}  // namespace ombre::fea
