#include "fea/brick_operator.h"

#include "base/tasks.h"

namespace ombre::fea {
namespace {

constexpr size_t piece_size = size_t{1} << 14, bricks_of_piece = 1024;

size_t colour_of(const Cell& cell, const Cell& period) {
  size_t colour = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const bool is_last_of_odd = (period[axis] & 1) != 0 && cell[axis] == period[axis] - 1;
    colour = 3 * colour + static_cast<size_t>(is_last_of_odd ? 2 : cell[axis] & 1);
  }
  return colour;
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

BrickOperator::BrickOperator(Bricks bricks, std::vector<Moduli> moduli, std::vector<uint8_t> free, int threads)
    : bricks_(std::move(bricks)),
      moduli_(std::move(moduli)),
      free_(std::move(free)),
      threads_(threads),
      stiffness_(brick_stiffness(bricks_.size_mm)),
      inverse_diagonal_(free_.size()) {
  for (uint32_t n = 0; n < bricks_.count(); ++n) {
    const Cell& cell = bricks_.cells[n];
    colours_[colour_of(cell, bricks_.period)].push_back(n);
    for (size_t d = 0; d < 24; ++d)
      inverse_diagonal_[3 * size_t{bricks_.nodes[n][d / 3]} + d % 3] +=
          stiffness_.diagonal(moduli_[n].shear, moduli_[n].bulk, d);
  }
  for (size_t n = 0; n < free_.size(); ++n)
    inverse_diagonal_[n] = free_[n] != 0 && inverse_diagonal_[n] > 0 ? 1 / inverse_diagonal_[n] : 0;
}

void BrickOperator::all_forces(const Vector& displacements, Vector& forces) const {
  forces.assign(displacements.size(), 0);
  for (const std::vector<uint32_t>& colour : colours_) {
    const auto work = [&](size_t piece) {
      const size_t end = std::min(colour.size(), (piece + 1) * bricks_of_piece);
      for (size_t n = piece * bricks_of_piece; n < end; ++n) {
        const uint32_t brick = colour[n];
        const auto& nodes = bricks_.nodes[brick];
        BrickVector u, f{};
        for (size_t c = 0; c < 8; ++c)
          for (size_t axis = 0; axis < 3; ++axis) u[3 * c + axis] = displacements[3 * size_t{nodes[c]} + axis];
        stiffness_.add_forces(moduli_[brick].shear, moduli_[brick].bulk, u, f);
        for (size_t c = 0; c < 8; ++c)
          for (size_t axis = 0; axis < 3; ++axis) forces[3 * size_t{nodes[c]} + axis] += f[3 * c + axis];
      }
    };
    run_parallel((colour.size() + bricks_of_piece - 1) / bricks_of_piece, threads_, work);
  }
}

// Displacements of what is held are zero in all that is passed here.
void BrickOperator::forces(const Vector& displacements, Vector& forces) const {
  all_forces(displacements, forces);
  for_pieces(forces.size(), threads_, [&](size_t begin, size_t end) {
    for (size_t n = begin; n < end; ++n)
      if (free_[n] == 0) forces[n] = 0;
  });
}

}  // namespace ombre::fea
