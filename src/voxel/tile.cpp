#include "voxel/tile.h"

namespace ombre::voxel {

Box centers(const Lattice& lattice, const TileBox& tile) {
  return {lattice.center(tile.lo[0], tile.lo[1], tile.lo[2]),
          lattice.center(tile.hi[0] - 1, tile.hi[1] - 1, tile.hi[2] - 1)};
}

StripSources::StripSources(const std::vector<std::unique_ptr<program::RowSampler>>& samplers, const TileBox& strip)
    : samplers_(samplers), strip_(strip), spans_(samplers.size()) {
  for (size_t tag = 0; tag < samplers.size(); ++tag) {
    if (!samplers[tag] || samplers[tag]->has_values()) continue;
    spans_[tag].resize(static_cast<size_t>(strip.size(2)));
    for (int64_t k = strip.lo[2]; k < strip.hi[2]; ++k) {
      auto& rows = spans_[tag][static_cast<size_t>(k - strip.lo[2])];
      samplers[tag]->layer(k, strip.lo[1], strip.hi[1], strip.hi[0], rows);
    }
  }
}

// Returns the first span that ends after voxel i: the one that contains i, or the next one.
static std::vector<program::Span>::const_iterator span_at(const std::vector<program::Span>& spans, int64_t i) {
  return std::upper_bound(spans.begin(), spans.end(), i, [](int64_t at, const program::Span& s) { return at < s.end; });
}

float StripSources::value(uint32_t tag, int64_t i, int64_t j, int64_t k) const {
  float value = 0;
  fill(tag, i, j, k, std::span(&value, 1));
  return value;
}

void StripSources::copy_values(const program::RowSampler& sampler, int64_t i, int64_t j, int64_t k,
                               std::span<double> values) {
  std::vector<float> row(values.size());
  sampler.values(i, j, k, row);
  std::ranges::copy(row, values.begin());
}

Interval StripSources::range(uint32_t tag, const TileBox& tile) const {
  const program::RowSampler& sampler = *samplers_[tag];
  return sampler.has_values() ? sampler.range(tile) : span_range(tag, tile);
}

Interval StripSources::span_range(uint32_t tag, const TileBox& tile) const {
  bool some_inside = false, some_outside = false;
  for (int64_t k = tile.lo[2]; k < tile.hi[2]; ++k) {
    for (int64_t j = tile.lo[1]; j < tile.hi[1]; ++j) {
      const auto& spans = row(tag, j, k);
      // Only the first span that ends after the tile's beginning matters.
      const auto span = span_at(spans, tile.lo[0]);
      const bool covers = span != spans.end() && span->begin <= tile.lo[0] && span->end >= tile.hi[0];
      const bool misses = span == spans.end() || span->begin >= tile.hi[0];
      some_inside = some_inside || !misses;
      some_outside = some_outside || !covers;
      if (some_inside && some_outside) return {0, 1};
    }
  }
  return some_inside ? 1 : 0;
}

program::SourceRanges StripSources::ranges(const TileBox& tile) const {
  return [this, &tile](const program::Read& read, const Box& where) {
    return has(read.tag) ? range(read.tag, tile) : read.source->range(read.channel, where);
  };
}

void StripVoxels::begin(const TileBox& strip, std::vector<std::vector<CheckHits>>& checks, size_t kept_thresholds) {
  strip_ = strip;
  checks_ = &checks;
  touched_ = false;
  thresholds_.resize(kept_thresholds);
  for (auto& row : thresholds_) row.resize(static_cast<size_t>(strip.voxels()));
}

void StripVoxels::touch() {
  if (touched_) return;
  ids_.assign(static_cast<size_t>(strip_.voxels()), 0);
  touched_ = true;
}

void StripVoxels::fill(const TileBox& tile, MaterialId material) {
  for (int64_t k = tile.lo[2]; k < tile.hi[2]; ++k)
    for (int64_t j = tile.lo[1]; j < tile.hi[1]; ++j) std::fill_n(at(tile.lo[0], j, k), tile.size(0), material);
}

void StripVoxels::note_check(size_t check, int64_t i, int64_t j, int64_t k) {
  CheckHits& hits = (*checks_)[static_cast<size_t>(k - strip_.lo[2])][check];
  const std::array<int64_t, 3> voxel{i, j, k};
  const auto order = [](const std::array<int64_t, 3>& v) { return std::array{v[2], v[1], v[0]}; };
  if (hits.count == 0 || order(voxel) < order(hits.first)) hits.first = voxel;
  ++hits.count;
}

}  // namespace ombre::voxel
