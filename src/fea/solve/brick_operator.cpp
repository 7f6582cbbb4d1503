#include "fea/solve/brick_operator.h"

#include <algorithm>

#include "base/system/tasks.h"
#include "fea/solve/cut_brick.h"

namespace ombre::fea {
namespace {

constexpr size_t piece_size = size_t{1} << 14, bricks_of_piece = 4096;

size_t colour_of(const Cell& cell, const Cell& period) {
  size_t colour = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const bool is_last_of_odd = (period[axis] & 1) != 0 && cell[axis] == period[axis] - 1;
    colour = 3 * colour + static_cast<size_t>(is_last_of_odd ? 2 : cell[axis] & 1);
  }
  return colour;
}

// Computes forces += packed matrix times displacements.
void add_product(const double* matrix, size_t size, const double* displacements, double* forces) {
  for (size_t row = 0; row < size; ++row) {
    double sum = 0;
    const double here = displacements[row];
    for (size_t column = 0; column < row; ++column) {
      sum += matrix[column] * displacements[column];
      forces[column] += matrix[column] * here;
    }
    forces[row] += sum + matrix[row] * here;
    matrix += row + 1;
  }
}

}  // namespace

void for_pieces(size_t count, int threads, const std::function<void(size_t, size_t)>& body) {
  const size_t pieces = (count + piece_size - 1) / piece_size;
  if (pieces == 1) return body(0, count);
  run_parallel(pieces, threads, [&](size_t n) { body(n * piece_size, std::min(count, (n + 1) * piece_size)); });
}

double dot(const Vector& a, const Vector& b, int threads) {
  std::vector<double> sums((a.size() + piece_size - 1) / piece_size);
  for_pieces(a.size(), threads, [&](size_t begin, size_t end) {
    double sum = 0;
    for (size_t n = begin; n < end; ++n) sum += a[n] * b[n];
    sums[begin / piece_size] = sum;
  });
  double sum = 0;
  for (const double part : sums) sum += part;
  return sum;
}

BrickOperator::BrickOperator(Bricks bricks, std::vector<Moduli> moduli, std::vector<uint8_t> free, int threads,
                             Vector more_diagonal, OwnMatrices own)
    : bricks_(std::move(bricks)),
      moduli_(std::move(moduli)),
      free_(std::move(free)),
      threads_(threads),
      more_diagonal_(std::move(more_diagonal)),
      own_(std::move(own)),
      unknowns_(free_.size() == bricks_.node_count() ? 1 : 3),
      stiffness_(brick_stiffness(bricks_.size_mm)),
      conductance_(brick_conductance(bricks_.size_mm)),
      inverse_diagonal_(more_diagonal_) {
  inverse_diagonal_.resize(free_.size());
  for (uint32_t n = 0; n < bricks_.count(); ++n) {
    (own_.of(n) ? own_colours_ : colours_)[colour_of(bricks_.cells[n], bricks_.period)].push_back(n);
    for (size_t d = 0; d < 8 * unknowns_; ++d)
      inverse_diagonal_[unknowns_ * bricks_.nodes[n][d / unknowns_] + d % unknowns_] += diagonal_of(n, d);
  }
  for (size_t n = 0; n < free_.size(); ++n)
    inverse_diagonal_[n] = free_[n] != 0 && inverse_diagonal_[n] > 0 ? 1 / inverse_diagonal_[n] : 0;
}

double BrickOperator::diagonal_of(uint32_t brick, size_t n) const {
  if (const double* matrix = own_.of(brick)) return matrix[packed_place(n, n)];
  const Moduli& moduli = moduli_[brick];
  if (unknowns_ == 1) return moduli.shear * conductance_.diagonal;
  return stiffness_.diagonal(moduli.shear, moduli.bulk, n);
}

void BrickOperator::add_forces_of(uint32_t brick, const Vector& displacements, Vector& forces) const {
  const auto& nodes = bricks_.nodes[brick];
  BrickVector u, f{};
  for (size_t c = 0; c < 8; ++c)
    for (size_t axis = 0; axis < 3; ++axis) u[3 * c + axis] = displacements[3 * size_t{nodes[c]} + axis];
  stiffness_.add_forces(moduli_[brick].shear, moduli_[brick].bulk, u, f);
  for (size_t c = 0; c < 8; ++c)
    for (size_t axis = 0; axis < 3; ++axis) forces[3 * size_t{nodes[c]} + axis] += f[3 * c + axis];
}

void BrickOperator::add_forces_of_four(const uint32_t* bricks, const Vector& displacements, Vector& forces) const {
  FourVector u, f{};
  Four shear, bulk;
  for (int lane = 0; lane < 4; ++lane) {
    const uint32_t brick = bricks[lane];
    shear[lane] = moduli_[brick].shear;
    bulk[lane] = moduli_[brick].bulk;
    for (size_t c = 0; c < 8; ++c)
      for (size_t axis = 0; axis < 3; ++axis)
        u[3 * c + axis][lane] = displacements[3 * size_t{bricks_.nodes[brick][c]} + axis];
  }
  stiffness_.add_four(shear, bulk, u, f);
  for (int lane = 0; lane < 4; ++lane)
    for (size_t c = 0; c < 8; ++c)
      for (size_t axis = 0; axis < 3; ++axis)
        forces[3 * size_t{bricks_.nodes[bricks[lane]][c]} + axis] += f[3 * c + axis][lane];
}

void BrickOperator::add_flows_of(uint32_t brick, const Vector& values, Vector& flows) const {
  const auto& nodes = bricks_.nodes[brick];
  std::array<double, 8> v, f{};
  for (size_t c = 0; c < 8; ++c) v[c] = values[nodes[c]];
  conductance_.add_flows(moduli_[brick].shear, v, f);
  for (size_t c = 0; c < 8; ++c) flows[nodes[c]] += f[c];
}

void BrickOperator::brick_forces(size_t brick, const double* displacements, double* forces) const {
  const size_t size = 8 * unknowns_;
  std::fill(forces, forces + size, 0.0);
  if (const double* matrix = own_.of(brick)) return add_product(matrix, size, displacements, forces);
  const Moduli& moduli = moduli_[brick];
  if (unknowns_ == 1) {
    std::array<double, 8> v, f{};
    std::copy_n(displacements, size, v.begin());
    conductance_.add_flows(moduli.shear, v, f);
    std::ranges::copy(f, forces);
    return;
  }
  BrickVector u, f{};
  std::copy_n(displacements, size, u.begin());
  stiffness_.add_forces(moduli.shear, moduli.bulk, u, f);
  std::ranges::copy(f, forces);
}

void BrickOperator::add_own(uint32_t brick, const Vector& displacements, Vector& forces) const {
  const auto& nodes = bricks_.nodes[brick];
  BrickVector u, f{};
  for (size_t c = 0; c < 8; ++c)
    for (size_t n = 0; n < unknowns_; ++n) u[unknowns_ * c + n] = displacements[unknowns_ * nodes[c] + n];
  add_product(own_.of(brick), 8 * unknowns_, u.data(), f.data());
  for (size_t c = 0; c < 8; ++c)
    for (size_t n = 0; n < unknowns_; ++n) forces[unknowns_ * nodes[c] + n] += f[unknowns_ * c + n];
}

// Adds the forces of some bricks of one colour.
void BrickOperator::add_of(const uint32_t* begin, const uint32_t* end, const Vector& displacements,
                           Vector& forces) const {
  if (unknowns_ == 1) {
    for (; begin != end; ++begin) add_flows_of(*begin, displacements, forces);
    return;
  }
  for (; end - begin >= 4; begin += 4) add_forces_of_four(begin, displacements, forces);
  for (; begin != end; ++begin) add_forces_of(*begin, displacements, forces);
}

void BrickOperator::all_forces(const Vector& displacements, Vector& forces) const {
  forces.assign(displacements.size(), 0);
  for (size_t n = 0; n < more_diagonal_.size(); ++n) forces[n] = more_diagonal_[n] * displacements[n];
  for (const std::vector<uint32_t>& colour : colours_) add_all(colour, false, displacements, forces);
  for (const std::vector<uint32_t>& colour : own_colours_) add_all(colour, true, displacements, forces);
}

// Adds the forces of all bricks of one colour that have, or do not have, a matrix of their own.
void BrickOperator::add_all(const std::vector<uint32_t>& colour, bool is_own, const Vector& displacements,
                            Vector& forces) const {
  const auto work = [&](size_t piece) {
    const uint32_t* const begin = colour.data() + piece * bricks_of_piece;
    const uint32_t* const end = colour.data() + std::min(colour.size(), (piece + 1) * bricks_of_piece);
    if (!is_own) return add_of(begin, end, displacements, forces);
    for (const uint32_t* brick = begin; brick != end; ++brick) add_own(*brick, displacements, forces);
  };
  const size_t pieces = (colour.size() + bricks_of_piece - 1) / bricks_of_piece;
  pieces <= 1 ? work(0) : run_parallel(pieces, threads_, work);
}

// Displacements of held unknowns must be zero.
void BrickOperator::forces(const Vector& displacements, Vector& forces) const {
  all_forces(displacements, forces);
  for_pieces(forces.size(), threads_, [&](size_t begin, size_t end) {
    for (size_t n = begin; n < end; ++n)
      if (free_[n] == 0) forces[n] = 0;
  });
}

}  // namespace ombre::fea
