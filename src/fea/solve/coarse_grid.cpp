#include "fea/solve/coarse_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace ombre::fea {
namespace {

constexpr double nodes_of_coarse_node = 40;
constexpr double least_coarse_nodes = 60, most_coarse_nodes = 1000;
constexpr double finer_each_try = 1.25;
// Share that is added to the diagonal, since some functions may be equal at all nodes that they reach.
constexpr double regularisation = 1e-8;

// A corner of a node's cell, and the node's share of its function.
struct Share {
  Cell corner{};
  double weight = 0;
};

std::array<Share, 8> shares_at(Vec3 p, Vec3 origin, double cell_mm) {
  Cell cell{};
  std::array<double, 3> within{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const double at = (p - origin)[static_cast<int>(axis)] / cell_mm;
    cell[axis] = static_cast<int32_t>(std::floor(at));
    within[axis] = at - cell[axis];
  }
  std::array<Share, 8> shares;
  for (size_t c = 0; c < 8; ++c) {
    shares[c].weight = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
      shares[c].corner[axis] = cell[axis] + brick_corners[c][axis];
      shares[c].weight *= brick_corners[c][axis] == 1 ? within[axis] : 1 - within[axis];
    }
  }
  return shares;
}

// The nodes of the grid that have nodes of the mesh in a cell beside them.
struct Grid {
  Vec3 origin;
  double cell_mm = 0;
  std::map<Cell, int> numbers;
};

Grid grid_over(const MeshView& mesh) {
  const auto count = static_cast<double>(mesh.node_count());
  const double wanted = std::clamp(count / nodes_of_coarse_node, least_coarse_nodes, most_coarse_nodes);
  const Box bounds = mesh.bounds();
  Grid grid{bounds.lo, std::cbrt(mesh.total_volume_mm3() / wanted), {}};
  // The grid is offset by half a cell, so that no plane of nodes lies on one of the grid.
  for (;; grid.cell_mm *= finer_each_try) {
    grid.origin = bounds.lo - Vec3{0.5 * grid.cell_mm, 0.5 * grid.cell_mm, 0.5 * grid.cell_mm};
    grid.numbers.clear();
    for (size_t n = 0; n < mesh.node_count(); ++n)
      for (const Share& share : shares_at(mesh.node(n), grid.origin, grid.cell_mm))
        grid.numbers.emplace(share.corner, 0);
    if (static_cast<double>(grid.numbers.size()) <= 2 * most_coarse_nodes) break;
  }
  int next = 0;
  for (auto& [corner, number] : grid.numbers) number = next++;
  return grid;
}

}  // namespace

CoarseGrid::CoarseGrid(const MeshView& mesh, size_t unknowns, const std::vector<int>& numbers,
                       const RowMatrix& matrix) {
  const Grid grid = grid_over(mesh);
  const int u = static_cast<int>(unknowns);
  std::vector<Eigen::Triplet<double>> entries;
  for (size_t node = 0; node < mesh.node_count(); ++node)
    for (const Share& share : shares_at(mesh.node(node), grid.origin, grid.cell_mm))
      for (int k = 0; k < u; ++k)
        if (const int row = numbers[node * unknowns + static_cast<size_t>(k)]; row >= 0 && share.weight > 0)
          entries.emplace_back(row, grid.numbers.at(share.corner) * u + k, share.weight);
  fine_from_coarse_.resize(matrix.rows(), static_cast<Eigen::Index>(grid.numbers.size()) * u);
  fine_from_coarse_.setFromTriplets(entries.begin(), entries.end());
  const RowMatrix forces = matrix * fine_from_coarse_;
  Eigen::SparseMatrix<double> coarse = fine_from_coarse_.transpose() * forces;
  double most = 0;
  for (Eigen::Index n = 0; n < coarse.rows(); ++n) most = std::max(most, coarse.coeff(n, n));
  for (Eigen::Index n = 0; n < coarse.rows(); ++n) coarse.coeffRef(n, n) += regularisation * most;
  factor_.compute(coarse);
}

void CoarseGrid::add_solution(const Eigen::VectorXd& right, Eigen::VectorXd& x) const {
  x += fine_from_coarse_ * factor_.solve(fine_from_coarse_.transpose() * right);
}

}  // namespace ombre::fea
