// Assembles sparse matrices over the nodes of a mesh from elements, and solves their systems.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/system/progress.h"
#include "fea/model/element_points.h"

namespace ombre::fea {

// The block that one element adds between the unknowns of two of its nodes, row by row; with one unknown only the first
// number is used.
using NodeBlock = std::array<double, 9>;
// Adds the blocks between node `a` of the element and each of its nodes. It is called from several threads.
using ElementRow =
    std::function<void(size_t element, const ElementPoints& points, size_t a, std::array<NodeBlock, 10>& blocks)>;

struct LinearSystem {
  MeshView mesh;
  size_t unknowns = 3;  // unknowns of a node
  ElementRow row;
  std::vector<uint8_t> free;          // 1 for each unknown that is solved for; the others are held
  std::vector<double> more_diagonal;  // added to the diagonal, unless empty
  int threads = 0;
};

// Computes the product of the elements' rows and the addition to the diagonal with `x`, without a matrix.
std::vector<double> product(const LinearSystem& system, const std::vector<double>& x);

struct LinearOptions {
  double tolerance = 1e-8;  // greatest residual, in the norm of the right side
  size_t most_iterations = 20000;
};
struct LinearReport {
  size_t iterations = 0;  // 0: solved directly
  double residual = 0;
};

// Solves matrix times x = `right` for the free unknowns; held ones are 0. The matrix must be symmetric and positive
// definite. Few unknowns are solved by a direct factorisation (Eigen's SimplicialLDLT), more by conjugate gradients
// with an incomplete one (IncompleteCholesky: Lin and More, 1999) and a coarse grid. Progress counts thousandths of the
// way to the tolerance. Throws Error when it does not converge or memory is short, and Cancelled.
std::vector<double> solve_system(const LinearSystem& system, const std::vector<double>& right,
                                 const LinearOptions& options, LinearReport& report, Progress* progress,
                                 const StopFlag* stop);

// Returns about the memory in bytes that solve_system() takes.
double system_bytes(const MeshView& mesh, size_t unknowns);

}  // namespace ombre::fea
