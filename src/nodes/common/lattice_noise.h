// Noise and cells whose points and gradients are drawn cell by cell: field sources, in place of formulas that would be
// very long.
#pragma once

#include <cstdint>

#include "program/field_source.h"

namespace ombre::nodes {

// A number of 64 bits for a cell, the same on every machine: SplitMix64 of Steele, Lea and Flood, 2014, over its
// indices one after the other.
uint64_t cell_bits(int64_t i, int64_t j, int64_t k, uint64_t seed);
// From 0 to 1, of the bits of a cell; `which` tells several such numbers apart.
double unit_of(uint64_t bits, int which);

// Sums of `octaves` noises, each `lacunarity` times as fine as the one before and `gain` times as strong.
struct OctaveSum {
  int octaves = 1;
  double gain = 0.5, lacunarity = 2;
  bool is_turbulent = false;  // sums how far they are from their mean
};

// Channel "value", from 0 to 1, in units of a cell.
// Simplex noise: Ken Perlin, "Noise hardware", 2001, in the form of Stefan Gustavson, "Simplex noise demystified",
// 2005, with a falloff of (1/2 - r^2)^4, which has no jumps between simplices.
program::SourceField make_simplex_noise(uint64_t seed, const OctaveSum& sum);
// Cellular noise: Steven Worley, "A cellular texture basis function", SIGGRAPH 1996: the distance to the nearest of
// points that are one to a cell, up to 1. Repeats after `period` cells; 0: not at all.
program::SourceField make_cellular_noise(uint64_t seed, const OctaveSum& sum, int period);

// Voronoi cells of points that are one to a cell of the lattice, moved from its middle by up to `jitter` halves of it.
// Channels, in units of a cell: "index" a number from 0 to 2^24 - 1 for each; "x", "y" and "z" the way from its point;
// "border" the distance to the nearest border; "point" the distance to its point. Borders are searched for two cells
// each way, which has all of them.
program::SourceField make_voronoi_cells(uint64_t seed, double jitter);

}  // namespace ombre::nodes
