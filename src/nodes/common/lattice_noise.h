// Noise and Voronoi cells with random points and gradients in each lattice cell. They are field sources, since formulas
// would be very long.
#pragma once

#include <cstdint>

#include "program/field_source.h"

namespace ombre::nodes {

// Returns 64 random bits for a cell, the same on every machine: SplitMix64 of Steele, Lea and Flood, 2014, applied to
// the indices one after the other.
uint64_t cell_bits(int64_t i, int64_t j, int64_t k, uint64_t seed);
// Returns a number from 0 to 1 made from the bits of a cell. `which` selects one of several such numbers.
double unit_of(uint64_t bits, int which);

// A sum of `octaves` noises, each of which is `lacunarity` times as fine and `gain` times as strong as the one before.
struct OctaveSum {
  int octaves = 1;
  double gain = 0.5, lacunarity = 2;
  bool is_turbulent = false;  // sums the distances from the mean instead
};

// Makes simplex noise. The channel "value" ranges from 0 to 1; lengths are in cells. Sources: Ken Perlin, "Noise
// hardware", 2001, in the form of Stefan Gustavson, "Simplex noise demystified", 2005, with a falloff of (1/2 - r^2)^4,
// which has no jumps between simplices.
program::SourceField make_simplex_noise(uint64_t seed, const OctaveSum& sum);
// Makes cellular noise: the distance, at most 1, to the nearest of random points, one of which lies in each cell
// (Steven Worley, "A cellular texture basis function", SIGGRAPH 1996). Repeats after `period` cells, or never if that
// is 0.
program::SourceField make_cellular_noise(uint64_t seed, const OctaveSum& sum, int period);

// Makes Voronoi cells of random points, one in each lattice cell, which are moved from the cell's centre by up to
// `jitter` halves of the cell. Lengths are in lattice cells. The channels are "index", a number from 0 to 2^24 - 1 for
// each Voronoi cell; "x", "y" and "z", the vector from its point; "border", the distance to the nearest border; and
// "point", the distance to its point. All borders lie within the two lattice cells on each side that are searched.
program::SourceField make_voronoi_cells(uint64_t seed, double jitter);

}  // namespace ombre::nodes
