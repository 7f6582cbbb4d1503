// A coarse grid over a mesh: what iterations on its nodes find slowly, found at once on few unknowns.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "fea/model/element_mesh.h"

namespace ombre::fea {

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

// Trilinear functions on a grid of some thousand nodes around the mesh, and the matrix between them (an auxiliary space
// as Xu, 1996, has them; two levels of additive Schwarz as Dryja and Widlund, 1987).
class CoarseGrid {
 public:
  // `numbers` are those of the matrix's rows for each unknown of each node; -1 where it is held.
  CoarseGrid(const MeshView& mesh, size_t unknowns, const std::vector<int>& numbers, const RowMatrix& matrix);

  // x += about the solution for `right`, as far as the grid can tell.
  void add_solution(const Eigen::VectorXd& right, Eigen::VectorXd& x) const;

 private:
  RowMatrix fine_from_coarse_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace ombre::fea
