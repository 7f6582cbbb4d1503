// The stiffness or the conductance of a mesh of bricks as an operator, without a matrix.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/system/progress.h"
#include "fea/model/bricks.h"
#include "fea/solve/brick_stiffness.h"
#include "fea/solve/own_matrices.h"

namespace ombre::fea {

// A number for each degree of freedom: x, y, z of node 0, and so on; in conduction one for each node.
using Vector = std::vector<double>;

// The operator of a mesh of bricks. In conduction, displacements are temperatures or potentials, forces are flows, a
// brick's shear modulus is its conductivity in W/(mm K) or S/mm, and its bulk modulus has no meaning.
class BrickOperator {
 public:
  // `free` is 1 for degrees of freedom that are solved for, else 0; the others count as held at zero. There are three
  // for each node, in conduction one. `more_diagonal` is added to the diagonal of all degrees of freedom; empty: 0.
  // Moduli of bricks with a matrix of their own are means over the whole brick, for coarser grids.
  BrickOperator(Bricks bricks, std::vector<Moduli> moduli, std::vector<uint8_t> free, int threads,
                Vector more_diagonal = {}, OwnMatrices own = {});

  const Bricks& bricks() const { return bricks_; }
  const std::vector<Moduli>& moduli() const { return moduli_; }
  const std::vector<uint8_t>& free() const { return free_; }
  const Vector& more_diagonal() const { return more_diagonal_; }
  size_t size() const { return free_.size(); }
  size_t unknowns() const { return unknowns_; }  // unknowns of a node: 3 or 1
  int threads() const { return threads_; }
  bool has_own_matrix(size_t brick) const { return own_.of(brick) != nullptr; }
  // Computes the forces from the displacements of a brick's nodes; both have as many numbers as the brick has unknowns.
  void brick_forces(size_t brick, const double* displacements, double* forces) const;

  // Computes the forces at all degrees of freedom, from all displacements.
  void all_forces(const Vector& displacements, Vector& forces) const;
  // Computes the forces at free degrees of freedom from free displacements; the others are 0.
  void forces(const Vector& displacements, Vector& forces) const;
  // Returns one over the diagonal; 0 where it is held.
  const Vector& inverse_diagonal() const { return inverse_diagonal_; }

 private:
  void add_all(const std::vector<uint32_t>& colour, bool is_own, const Vector& displacements, Vector& forces) const;
  void add_own(uint32_t brick, const Vector& displacements, Vector& forces) const;
  void add_of(const uint32_t* begin, const uint32_t* end, const Vector& displacements, Vector& forces) const;
  void add_forces_of(uint32_t brick, const Vector& displacements, Vector& forces) const;
  void add_forces_of_four(const uint32_t* bricks, const Vector& displacements, Vector& forces) const;
  void add_flows_of(uint32_t brick, const Vector& values, Vector& flows) const;
  double diagonal_of(uint32_t brick, size_t n) const;

  Bricks bricks_;
  std::vector<Moduli> moduli_;
  std::vector<uint8_t> free_;
  int threads_;
  Vector more_diagonal_;
  OwnMatrices own_;
  size_t unknowns_;
  BrickStiffness stiffness_;
  BrickConductance conductance_;
  // Bricks of one colour share no node, so their forces can be added at the same time, in any order. Along an axis with
  // an odd period the last one needs a third colour.
  std::array<std::vector<uint32_t>, 27> colours_, own_colours_;
  Vector inverse_diagonal_;
};

// Products of long vectors. Sums are made in one order, whatever the number of threads.
double dot(const Vector& a, const Vector& b, int threads);
// Calls body(begin, end) for pieces of [0, count).
void for_pieces(size_t count, int threads, const std::function<void(size_t, size_t)>& body);

}  // namespace ombre::fea
