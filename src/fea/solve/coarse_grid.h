// A coarse grid over a mesh. It solves directly, with few unknowns, for errors that iterations on the nodes reduce
// slowly.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "fea/model/element_mesh.h"

namespace ombre::fea {

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

// Trilinear functions on a grid of some thousand nodes around the mesh, and the matrix between them (an auxiliary space
// after Xu, 1996; two levels of additive Schwarz after Dryja and Widlund, 1987).
class CoarseGrid {
 public:
  // `numbers` are the rows of the matrix for each unknown of each node; -1 for held ones.
  CoarseGrid(const MeshView& mesh, size_t unknowns, const std::vector<int>& numbers, const RowMatrix& matrix);

  // Adds to x an approximate solution for `right`, within the functions of the grid.
  void add_solution(const Eigen::VectorXd& right, Eigen::VectorXd& x) const;

 private:
  RowMatrix fine_from_coarse_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace ombre::fea
