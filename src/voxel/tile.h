// Boxes of voxels, and the data of one strip of them.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "voxel/lattice.h"
#include "voxel/material_program.h"

namespace ombre::voxel {

// Returns the greatest multiple of `unit` that is at most `index`, which may be negative.
inline int64_t multiple_below(int64_t index, int64_t unit) {
  const int64_t rest = index % unit;
  return index - (rest < 0 ? rest + unit : rest);
}

// Returns the box around a tile's voxel centres.
Box centers(const Lattice& lattice, const TileBox& tile);

// Values of sources along the rows of a strip, for those sources that give values for whole rows. A strip consists of
// some rows of a few layers.
class StripSources {
 public:
  // `samplers` are indexed by tag, null for sources that are evaluated at each point. They must outlive this object.
  StripSources(const std::vector<std::unique_ptr<program::RowSampler>>& samplers, const TileBox& strip);

  bool has(uint32_t tag) const { return tag < samplers_.size() && samplers_[tag]; }
  float value(uint32_t tag, int64_t i, int64_t j, int64_t k) const;
  // Returns the range of a source in a tile. For spans it is 1 if the whole tile is inside, 0 if it is outside, else
  // [0, 1].
  Interval range(uint32_t tag, const TileBox& tile) const;
  // Returns the ranges in the form that evaluate_intervals takes. The result is valid as long as this object and the
  // tile.
  program::SourceRanges ranges(const TileBox& tile) const;
  // Writes to values[n] the value of voxel i_begin + n of the row. For spans it is 1 inside and 0 outside.
  template <class T>
  void fill(uint32_t tag, int64_t i_begin, int64_t j, int64_t k, std::span<T> values) const {
    if (samplers_[tag]->has_values()) return copy_values(*samplers_[tag], i_begin, j, k, values);
    std::fill(values.begin(), values.end(), T{0});
    const int64_t i_end = i_begin + static_cast<int64_t>(values.size());
    for (const program::Span& span : row(tag, j, k)) {
      const int64_t from = std::max(span.begin, i_begin), to = std::min(span.end, i_end);
      if (from < to) std::fill(values.begin() + (from - i_begin), values.begin() + (to - i_begin), T{1});
    }
  }

 private:
  static void copy_values(const program::RowSampler& sampler, int64_t i, int64_t j, int64_t k,
                          std::span<float> values) {
    sampler.values(i, j, k, values);
  }
  static void copy_values(const program::RowSampler& sampler, int64_t i, int64_t j, int64_t k,
                          std::span<double> values);
  Interval span_range(uint32_t tag, const TileBox& tile) const;
  const std::vector<program::Span>& row(uint32_t tag, int64_t j, int64_t k) const {
    return spans_[tag][static_cast<size_t>(k - strip_.lo[2])][static_cast<size_t>(j - strip_.lo[1])];
  }

  const std::vector<std::unique_ptr<program::RowSampler>>& samplers_;
  TileBox strip_;
  std::vector<std::vector<std::vector<std::vector<program::Span>>>> spans_;  // [tag][layer][row]; empty for values
};

// The materials of a strip's voxels, with x varying fastest, then y, then z. Memory is written only once a voxel is
// set. For error diffusion, which chooses materials later, also their thresholds.
class StripVoxels {
 public:
  // Clears all voxels. `checks[layer][check]` must outlive this object.
  void begin(const TileBox& strip, std::vector<std::vector<CheckHits>>& checks, size_t kept_thresholds = 0);
  bool touched() const { return touched_; }  // false if all voxels are void
  const std::vector<MaterialId>& ids() const { return ids_; }

  MaterialId* at(int64_t i, int64_t j, int64_t k) {
    touch();
    return ids_.data() + offset(i, j, k);
  }
  size_t kept_thresholds() const { return thresholds_.size(); }
  float* threshold(size_t t, int64_t i, int64_t j, int64_t k) { return thresholds_[t].data() + offset(i, j, k); }
  void fill(const TileBox& tile, MaterialId material);
  void note_check(size_t check, int64_t i, int64_t j, int64_t k);

 private:
  void touch();
  size_t offset(int64_t i, int64_t j, int64_t k) const {
    return static_cast<size_t>(((k - strip_.lo[2]) * strip_.size(1) + (j - strip_.lo[1])) * strip_.size(0) +
                               (i - strip_.lo[0]));
  }

  TileBox strip_;
  bool touched_ = false;
  std::vector<std::vector<float>> thresholds_;
  std::vector<MaterialId> ids_;
  std::vector<std::vector<CheckHits>>* checks_ = nullptr;
};

}  // namespace ombre::voxel
