// Places of several points in one prism, by vector instructions. Results are bit-identical to those of Prism.
#pragma once

#include "import/charts/shell_prisms.h"

namespace ombre::importing {

struct PrismRow {
  static constexpr size_t most = 16;  // points

  alignas(64) std::array<double, most> x, y, z;                // the points
  alignas(64) std::array<double, most> second, third, height;  // their places
  alignas(64) std::array<std::array<double, most>, 9> slopes;  // derivatives of these three by x, y and z
};

// The functions below for an instruction set.
struct PrismKernels {
  size_t (*places)(const PrismNumbers&, Interval, double, PrismRow&, size_t);
  void (*slopes)(const PrismNumbers&, PrismRow&, size_t);
};
// Returns those of each instruction set of this processor, the fastest first.
std::vector<PrismKernels> prism_kernels();

// Finds the places of the first points of a row, and returns how many points from the first one on have a height among
// the given ones and shares that are all above `least_share`. Places of others are undefined. The row has points up to
// the next multiple of 8 or more.
size_t find_places(const PrismNumbers& prism, Interval heights, double least_share, PrismRow& row, size_t count);
// Finds the derivatives at those places.
void find_slopes(const PrismNumbers& prism, PrismRow& row, size_t count);

}  // namespace ombre::importing
