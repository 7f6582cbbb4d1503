#include "fea/solve/node_matrix.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/system/stopwatch.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "fea/solve/coarse_grid.h"

namespace ombre::fea {
namespace {

using Matrix = RowMatrix;
using EigenVector = Eigen::VectorXd;

// Greatest number of unknowns for which a direct factorisation is quicker than iterations; measured with C3D4 and
// C3D10.
constexpr size_t most_direct = 4000;
constexpr size_t nodes_of_task = 256;

// The elements at each node, and the node's place in each.
class ElementsOfNodes {
 public:
  struct Entry {
    uint32_t element;
    uint8_t place;
  };

  explicit ElementsOfNodes(const MeshView& mesh) : begins_(mesh.node_count() + 1) {
    for (size_t element = 0; element < mesh.count(); ++element)
      for (const uint32_t node : mesh.nodes(element)) ++begins_[node + 1];
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    entries_.resize(begins_.back());
    std::vector<size_t> next(begins_.begin(), begins_.end() - 1);
    for (uint32_t element = 0; element < mesh.count(); ++element) {
      const auto nodes = mesh.nodes(element);
      for (size_t place = 0; place < nodes.size(); ++place)
        entries_[next[nodes[place]]++] = {element, static_cast<uint8_t>(place)};
    }
  }

  std::span<const Entry> at(size_t node) const {
    return {entries_.data() + begins_[node], begins_[node + 1] - begins_[node]};
  }

 private:
  std::vector<size_t> begins_;
  std::vector<Entry> entries_;
};

void for_nodes(const LinearSystem& system, const std::function<void(size_t)>& body) {
  const size_t count = system.mesh.node_count();
  run_parallel((count + nodes_of_task - 1) / nodes_of_task, system.threads, [&](size_t task) {
    const size_t end = std::min(count, (task + 1) * nodes_of_task);
    for (size_t node = task * nodes_of_task; node < end; ++node) body(node);
  });
}

// A row of the matrix: the nodes that share an element with a node, and the blocks between.
class NodeRow {
 public:
  void make(const LinearSystem& system, const ElementsOfNodes& elements, size_t node) {
    neighbours.clear();
    for (const auto& [element, place] : elements.at(node))
      for (const uint32_t other : system.mesh.nodes(element)) neighbours.push_back(other);
    std::ranges::sort(neighbours);
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    blocks.assign(neighbours.size(), NodeBlock{});
    const size_t square = system.unknowns * system.unknowns;
    for (const auto& [element, place] : elements.at(node)) {
      find_points(system.mesh, element, points_);
      std::array<NodeBlock, 10> own{};
      system.row(element, points_, place, own);
      const auto nodes = system.mesh.nodes(element);
      for (size_t n = 0; n < nodes.size(); ++n) {
        const auto at = std::ranges::lower_bound(neighbours, nodes[n]) - neighbours.begin();
        for (size_t k = 0; k < square; ++k) blocks[static_cast<size_t>(at)][k] += own[n][k];
      }
    }
    if (system.more_diagonal.empty()) return;
    const auto at = std::ranges::lower_bound(neighbours, node) - neighbours.begin();
    for (size_t k = 0; k < system.unknowns; ++k)
      blocks[static_cast<size_t>(at)][k * system.unknowns + k] += system.more_diagonal[node * system.unknowns + k];
  }

  std::vector<uint32_t> neighbours;
  std::vector<NodeBlock> blocks;

 private:
  ElementPoints points_;
};

// Returns the numbers of the free unknowns; -1 for the others.
std::vector<int> numbers_of(const std::vector<uint8_t>& free) {
  std::vector<int> numbers(free.size(), -1);
  int next = 0;
  for (size_t n = 0; n < free.size(); ++n)
    if (free[n] != 0) numbers[n] = next++;
  return numbers;
}

// Returns the matrix between the free unknowns.
Matrix matrix_of(const LinearSystem& system, const std::vector<int>& numbers, int size) {
  const ElementsOfNodes elements(system.mesh);
  const size_t u = system.unknowns;
  // The length of each row is counted first, then the numbers are computed.
  std::vector<int> free_of(system.mesh.node_count());
  for (size_t n = 0; n < numbers.size(); ++n) free_of[n / u] += numbers[n] >= 0 ? 1 : 0;
  Matrix matrix(size, size);
  std::vector<int64_t> lengths(static_cast<size_t>(size));
  for_nodes(system, [&](size_t node) {
    if (free_of[node] == 0) return;
    std::vector<uint32_t> neighbours;
    for (const auto& [element, place] : elements.at(node))
      for (const uint32_t other : system.mesh.nodes(element)) neighbours.push_back(other);
    std::ranges::sort(neighbours);
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    int64_t columns = 0;
    for (const uint32_t other : neighbours) columns += free_of[other];
    for (size_t i = 0; i < u; ++i)
      if (const int row = numbers[node * u + i]; row >= 0) lengths[static_cast<size_t>(row)] = columns;
  });
  const int64_t total = std::accumulate(lengths.begin(), lengths.end(), int64_t{0});
  if (total > std::numeric_limits<int>::max())
    throw Error(Code::not_solved, "the equations have more than 2^31 coefficients; choose larger elements");
  matrix.resizeNonZeros(total);
  int* const begins = matrix.outerIndexPtr();
  begins[0] = 0;
  for (size_t row = 0; row < lengths.size(); ++row) begins[row + 1] = begins[row] + static_cast<int>(lengths[row]);
  for_nodes(system, [&](size_t node) {
    if (free_of[node] == 0) return;
    NodeRow row;
    row.make(system, elements, node);
    for (size_t i = 0; i < u; ++i) {
      const int number = numbers[node * u + i];
      if (number < 0) continue;
      int at = begins[number];
      for (size_t n = 0; n < row.neighbours.size(); ++n)
        for (size_t j = 0; j < u; ++j) {
          const int column = numbers[row.neighbours[n] * u + j];
          if (column < 0) continue;
          matrix.innerIndexPtr()[at] = column;
          matrix.valuePtr()[at++] = row.blocks[n][i * u + j];
        }
    }
  });
  return matrix;
}

// A preconditioner that watches the iterations: Eigen passes it the residual in each, so it can look at the stop flag
// and report progress.
struct Watch {
  const StopFlag* stop = nullptr;
  Progress* progress = nullptr;
  double scale = 1, tolerance = 1e-8;
  Stopwatch stopwatch = {};
  uint64_t farthest = 0;

  void look(double residual) {
    if (stop && stop->requested()) throw Cancelled();
    constexpr double parts = 1000;
    if (!progress || !(residual > 0) || !(scale > 0)) return;
    const double way = std::clamp(std::log(residual / scale) / std::log(tolerance), 0.0, 1.0);
    farthest = std::max(farthest, static_cast<uint64_t>(parts * way));
    HowFar how_far{farthest, static_cast<uint64_t>(parts)};
    if (farthest > 0) how_far.seconds_left = stopwatch.seconds() * (parts / static_cast<double>(farthest) - 1);
    progress->update(how_far);
  }
};

// An incomplete factorisation for errors that vary from node to node, and a coarse grid for the rest.
class TwoLevels {
 public:
  using Fine = Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>;

  template <class Any>
  TwoLevels& analyzePattern(const Any&) {
    return *this;
  }
  template <class Any>
  TwoLevels& factorize(const Any& matrix) {
    fine_.compute(matrix);
    return *this;
  }
  template <class Any>
  TwoLevels& compute(const Any& matrix) {
    return factorize(matrix);
  }
  EigenVector solve(const EigenVector& right) const {
    watch->look(right.norm());
    EigenVector x = fine_.solve(right);
    coarse->add_solution(right, x);
    return x;
  }
  Eigen::ComputationInfo info() const { return fine_.info(); }

  Watch* watch = nullptr;
  const CoarseGrid* coarse = nullptr;

 private:
  Fine fine_;
};

[[noreturn]] void fail_to_converge(const LinearReport& report) {
  throw Error(
      Code::not_solved,
      "the equations did not converge: after " + format_count(report.iterations) +
          " iterations the forces are still off by " + format_rounded(report.residual, 2) +
          " of the loads; parts that hang together at an edge or a corner may turn about it, elements may be flat, " +
          "or properties differ too much: choose smaller elements, or support more of the part");
}

EigenVector solve_directly(const Matrix& matrix, const EigenVector& right) {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success)
    throw Error(Code::not_solved, "the equations have no solution: parts may move freely, or elements may be flat");
  EigenVector x = factor.solve(right);
  x += factor.solve(right - matrix * x);
  return x;
}

EigenVector iterate(const Matrix& matrix, const CoarseGrid& coarse, const EigenVector& right,
                    const LinearOptions& options, LinearReport& report, Watch& watch) {
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper, TwoLevels> gradients;
  gradients.preconditioner().coarse = &coarse;
  gradients.preconditioner().watch = &watch;
  gradients.setTolerance(options.tolerance);
  gradients.setMaxIterations(static_cast<Eigen::Index>(options.most_iterations));
  gradients.compute(matrix);
  if (gradients.preconditioner().info() != Eigen::Success)
    throw Error(Code::not_solved, "the equations could not be factorised: elements may be flat or inside out");
  EigenVector x = gradients.solve(right);
  report.iterations = static_cast<size_t>(gradients.iterations());
  report.residual = gradients.error();
  if (!(report.residual <= options.tolerance)) fail_to_converge(report);
  return x;
}

}  // namespace

std::vector<double> product(const LinearSystem& system, const std::vector<double>& x) {
  const ElementsOfNodes elements(system.mesh);
  const size_t u = system.unknowns;
  std::vector<double> result(x.size());
  for_nodes(system, [&](size_t node) {
    NodeRow row;
    row.make(system, elements, node);
    for (size_t n = 0; n < row.neighbours.size(); ++n)
      for (size_t i = 0; i < u; ++i)
        for (size_t j = 0; j < u; ++j) result[node * u + i] += row.blocks[n][i * u + j] * x[row.neighbours[n] * u + j];
  });
  return result;
}

std::vector<double> solve_system(const LinearSystem& system, const std::vector<double>& right,
                                 const LinearOptions& options, LinearReport& report, Progress* progress,
                                 const StopFlag* stop) {
  const std::vector<int> numbers = numbers_of(system.free);
  const int size = static_cast<int>(std::ranges::count_if(numbers, [](int n) { return n >= 0; }));
  std::vector<double> x(right.size());
  EigenVector b(size);
  for (size_t n = 0; n < numbers.size(); ++n)
    if (numbers[n] >= 0) b[numbers[n]] = right[n];
  Watch watch{stop, progress, b.norm(), options.tolerance};
  if (!(watch.scale > 0)) return x;
  watch.look(watch.scale);
  const Matrix matrix = matrix_of(system, numbers, size);
  watch.look(watch.scale);
  EigenVector found;
  if (static_cast<size_t>(size) <= most_direct) {
    found = solve_directly(matrix, b);
    report.residual = (b - matrix * found).norm() / watch.scale;
    if (!(report.residual <= std::max(options.tolerance, 1e-6))) fail_to_converge(report);
  } else {
    const CoarseGrid coarse(system.mesh, system.unknowns, numbers, matrix);
    watch.look(watch.scale);
    found = iterate(matrix, coarse, b, options, report, watch);
  }
  for (size_t n = 0; n < numbers.size(); ++n)
    if (numbers[n] >= 0) x[n] = found[numbers[n]];
  return x;
}

double system_bytes(const MeshView& mesh, size_t unknowns) {
  // Typical numbers of nodes that share an element with a node, itself included: in tetrahedra from Delaunay refinement
  // and in grids.
  constexpr std::array<double, 3> neighbours{15, 29, 27};
  // Bytes of a coefficient: the matrix, half of it in the incomplete factorisation, and the copies while that is made.
  constexpr double of_coefficient = 12 + 3 * 6, of_unknown = 15 * sizeof(double);
  const auto count = static_cast<double>(mesh.node_count() * unknowns);
  const double coefficients = count * neighbours[static_cast<size_t>(mesh.kind())] * static_cast<double>(unknowns);
  return coefficients * of_coefficient + count * of_unknown +
         static_cast<double>(mesh.count() * mesh.shape().nodes) * 12;
}

}  // namespace ombre::fea
