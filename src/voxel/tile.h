// Evaluates boxes of voxels: settles what intervals can settle, the rest row by row.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "eval/rows.h"
#include "voxel/layers.h"

namespace ombre::voxel {

// Voxels [lo, hi) on each axis.
struct TileBox {
  std::array<int64_t, 3> lo{}, hi{};
  int64_t size(int axis) const { return hi[static_cast<size_t>(axis)] - lo[static_cast<size_t>(axis)]; }
  int64_t voxels() const { return size(0) * size(1) * size(2); }
};

// The box around a tile's voxel centres.
Box centers(const Lattice& lattice, const TileBox& tile);

// What the sources that know their rows say in a strip of rows of a few layers.
class StripSources {
 public:
  // `samplers` by tag; null for sources that are asked point by point.
  StripSources(const std::vector<std::unique_ptr<program::RowSampler>>& samplers, const TileBox& strip);

  bool has(uint32_t tag) const { return tag < spans_.size() && !spans_[tag].empty(); }
  // 1 or 0 where the whole tile is inside or outside, else both.
  Interval range(uint32_t tag, const TileBox& tile) const;
  // values[n] = 1 where voxel i_begin + n of the row is inside.
  void fill(uint32_t tag, int64_t i_begin, int64_t j, int64_t k, std::span<double> values) const;

 private:
  const std::vector<program::Span>& row(uint32_t tag, int64_t j, int64_t k) const {
    return spans_[tag][static_cast<size_t>(k - strip_.lo[2])][static_cast<size_t>(j - strip_.lo[1])];
  }

  TileBox strip_;
  std::vector<std::vector<std::vector<std::vector<program::Span>>>> spans_;  // [tag][layer][row]
};

// One thread's work on one strip. Writes material ids into a dense buffer of the strip.
class StripEvaluator {
 public:
  // `program` is that of the materials, or what is left of it where the strip lies. All must outlive this.
  StripEvaluator(const MaterialProgram& materials, const program::Program& program, const Lattice& lattice,
                 Dither dither, uint64_t seed);

  // Buffers hold the strip's voxels, x fastest, then y, then z. Returns false if all of it is void,
  // and then leaves the buffer alone.
  bool run(const TileBox& strip, const StripSources& sources, std::vector<MaterialId>& buffer,
           std::vector<std::vector<CheckHits>>& checks);

 private:
  void descend(const program::Program& program, const TileBox& tile);
  void fill(const TileBox& tile, MaterialId material);
  void evaluate(program::Program program, const TileBox& tile);
  void evaluate_row(const program::Program& program, size_t early, const TileBox& tile, int64_t j, int64_t k);
  void quantise_row(const program::Program& program, int64_t begin, int64_t end, const TileBox& tile, int64_t j,
                    int64_t k);
  void count_checks(const program::Program& program, const TileBox& tile, int64_t j, int64_t k);
  MaterialId* voxels(int64_t i, int64_t j, int64_t k);

  const MaterialProgram& materials_;
  const program::Program& program_;
  const Lattice& lattice_;
  Dither dither_;
  uint64_t seed_;
  TileBox strip_;
  const StripSources* sources_ = nullptr;
  std::vector<MaterialId>* buffer_ = nullptr;
  std::vector<std::vector<CheckHits>>* checks_ = nullptr;
  bool touched_ = false;
  eval::RowEvaluator rows_;
  std::vector<double> xs_, fractions_;
  std::vector<Interval> intervals_;
};

}  // namespace ombre::voxel
