// Boxes of voxels, and what is known of one strip of them.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "voxel/lattice.h"
#include "voxel/material_program.h"

namespace ombre::voxel {

// The greatest multiple of `unit` that is at most `index`, which may be negative.
inline int64_t multiple_below(int64_t index, int64_t unit) {
  const int64_t rest = index % unit;
  return index - (rest < 0 ? rest + unit : rest);
}

// The box around a tile's voxel centres.
Box centers(const Lattice& lattice, const TileBox& tile);

// What the sources that know their rows say in a strip of rows of a few layers.
class StripSources {
 public:
  // `samplers` by tag, null for sources that are evaluated point by point; they outlive this.
  StripSources(const std::vector<std::unique_ptr<program::RowSampler>>& samplers, const TileBox& strip);

  bool has(uint32_t tag) const { return tag < samplers_.size() && samplers_[tag]; }
  float value(uint32_t tag, int64_t i, int64_t j, int64_t k) const;
  // The range of spans is 1 or 0 where the whole tile is inside or outside, else both.
  Interval range(uint32_t tag, const TileBox& tile) const;
  // The same as evaluate_intervals asks for it; valid as long as this and the tile.
  program::SourceRanges ranges(const TileBox& tile) const;
  // values[n] is that of voxel i_begin + n of the row; of spans, 1 inside and 0 outside.
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

// The materials of a strip's voxels, x fastest, then y, then z. Nothing is written until a voxel is.
// For error diffusion, which chooses later, also their thresholds.
class StripVoxels {
 public:
  // Forgets what was there; `checks[layer][check]` outlives this.
  void begin(const TileBox& strip, std::vector<std::vector<CheckHits>>& checks, size_t kept_thresholds = 0);
  bool touched() const { return touched_; }  // else all of it is void
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
