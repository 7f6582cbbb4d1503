// The solid voxels of a box of a design, as bits, and what is counted in them.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "base/system/progress.h"
#include "jobs/printable/bit_layer.h"
#include "jobs/slice/plan.h"

namespace ombre::compile {

// Axes along which a box repeats.
using Periodic = std::array<bool, 3>;

struct SolidGrid {
  voxel::Lattice lattice;
  std::vector<BitLayer> layers;                   // by z
  std::array<std::vector<uint64_t>, 3> sections;  // solid voxels of each slice across x, y and z
  std::map<std::string, uint64_t> of_material;    // voxels of each
  std::array<double, 3> mean_place{};             // of solid voxels, mm

  uint64_t solid() const;
  uint64_t voxels() const { return lattice.voxels(); }
};

// Makes the grid; the plan's stages must be prepared. Throws Cancelled.
SolidGrid solid_grid(const Plan& plan, int threads, size_t memory_bytes, Progress* progress, const StopFlag* stop);

// Euler's number of the voxels as cubes that hang together by their faces: the pieces less the handles plus the closed
// hollows. Counted by the voxels, pairs, squares and blocks of 8 that are wholly solid.
int64_t euler_number(const SolidGrid& grid, const Periodic& periodic);

// Connected pieces of the solid, by the faces of its voxels, or of the void, by faces, edges and corners.
struct GridPieces {
  uint64_t count = 0;
  uint64_t enclosed = 0;  // those that do not reach the border of the box
  uint64_t largest = 0;   // voxels
};
GridPieces solid_pieces(const SolidGrid& grid, const Periodic& periodic);
GridPieces void_pieces(const SolidGrid& grid, const Periodic& periodic);

// The thickness of the thinnest place of the solid, or of the void, and the place.
struct ThinPlace {
  double least_mm = 0;
  bool is_found = false;  // false: there is none below `least_mm`, which is as far as was looked
  Vec3 place;             // mm
};
ThinPlace thinnest_place(const SolidGrid& grid, const Periodic& periodic, bool of_void, const StopFlag* stop);

}  // namespace ombre::compile
