#include "voxel/tile.h"

#include <algorithm>

#include "program/passes/passes.h"
#include "voxel/quantise.h"

namespace ombre::voxel {
namespace {

// Voxels of a tile that is evaluated row by row. Long programs pay for smaller tiles, in which more of
// them falls away.
struct Leaf {
  int64_t width, height;
};
constexpr Leaf widest_leaf{64, 8}, small_leaf{16, 4};
constexpr size_t long_program = 100;

Leaf leaf_for(const program::Program& program) { return program.code.size() < long_program ? widest_leaf : small_leaf; }

bool is_leaf(const TileBox& tile, Leaf leaf) { return tile.size(0) <= leaf.width && tile.size(1) <= leaf.height; }

// Tiles are halved along their longer side, counted in leaves, until they are leaves.
std::array<TileBox, 2> halves(const TileBox& tile, Leaf leaf) {
  const size_t axis = tile.size(0) * leaf.height > tile.size(1) * leaf.width ? 0 : 1;
  const int64_t unit = axis == 0 ? leaf.width : leaf.height;
  const int64_t units = (tile.size(static_cast<int>(axis)) + unit - 1) / unit;
  const int64_t cut = tile.lo[axis] + (units / 2) * unit;
  std::array<TileBox, 2> parts{tile, tile};
  parts[0].hi[axis] = cut;
  parts[1].lo[axis] = cut;
  return parts;
}

}  // namespace

Box centers(const Lattice& lattice, const TileBox& tile) {
  return {lattice.center(tile.lo[0], tile.lo[1], tile.lo[2]),
          lattice.center(tile.hi[0] - 1, tile.hi[1] - 1, tile.hi[2] - 1)};
}

StripSources::StripSources(const std::vector<std::unique_ptr<program::RowSampler>>& samplers, const TileBox& strip)
    : strip_(strip), spans_(samplers.size()) {
  for (size_t tag = 0; tag < samplers.size(); ++tag) {
    if (!samplers[tag]) continue;
    spans_[tag].resize(static_cast<size_t>(strip.size(2)));
    for (int64_t k = strip.lo[2]; k < strip.hi[2]; ++k) {
      auto& rows = spans_[tag][static_cast<size_t>(k - strip.lo[2])];
      samplers[tag]->layer(k, strip.lo[1], strip.hi[1], strip.hi[0], rows);
    }
  }
}

Interval StripSources::range(uint32_t tag, const TileBox& tile) const {
  bool some_inside = false, some_outside = false;
  for (int64_t k = tile.lo[2]; k < tile.hi[2]; ++k) {
    for (int64_t j = tile.lo[1]; j < tile.hi[1]; ++j) {
      const auto& spans = row(tag, j, k);
      // The first span that ends behind the tile's beginning decides.
      const auto span = std::upper_bound(spans.begin(), spans.end(), tile.lo[0],
                                         [](int64_t i, const program::Span& s) { return i < s.end; });
      const bool covers = span != spans.end() && span->begin <= tile.lo[0] && span->end >= tile.hi[0];
      const bool misses = span == spans.end() || span->begin >= tile.hi[0];
      some_inside = some_inside || !misses;
      some_outside = some_outside || !covers;
      if (some_inside && some_outside) return {0, 1};
    }
  }
  return some_inside ? 1 : 0;
}

void StripSources::fill(uint32_t tag, int64_t i_begin, int64_t j, int64_t k, std::span<double> values) const {
  std::fill(values.begin(), values.end(), 0.0);
  const int64_t i_end = i_begin + static_cast<int64_t>(values.size());
  for (const program::Span& span : row(tag, j, k)) {
    const int64_t from = std::max(span.begin, i_begin), to = std::min(span.end, i_end);
    if (from < to) std::fill(values.begin() + (from - i_begin), values.begin() + (to - i_begin), 1.0);
  }
}

StripEvaluator::StripEvaluator(const MaterialProgram& materials, const program::Program& program,
                               const Lattice& lattice, Dither dither, uint64_t seed)
    : materials_(materials),
      program_(program),
      lattice_(lattice),
      dither_(dither),
      seed_(seed),
      rows_(widest_leaf.width),
      xs_(widest_leaf.width) {
  fractions_.resize(materials.materials.size());
}

bool StripEvaluator::run(const TileBox& strip, const StripSources& sources, std::vector<MaterialId>& buffer,
                         std::vector<std::vector<CheckHits>>& checks) {
  strip_ = strip;
  sources_ = &sources;
  buffer_ = &buffer;
  checks_ = &checks;
  touched_ = false;
  descend(program_, strip);
  return touched_;
}

void StripEvaluator::descend(const program::Program& program, const TileBox& tile) {
  evaluate_intervals(program, centers(lattice_, tile), intervals_, [&](const program::Read& read, const Box& where) {
    return sources_->has(read.tag) ? sources_->range(read.tag, tile) : read.source->range(read.channel, where);
  });
  const Interval inside = intervals_[program.outputs[0]];
  if (inside == Interval(0)) return;
  if (inside == Interval(1)) {
    // Settled when one fraction is 1, the others 0, and nothing can be wrong.
    size_t full = 0, which = 0;
    bool settled = true;
    for (size_t n = 1; n < program.outputs.size(); ++n) {
      const Interval value = intervals_[program.outputs[n]];
      const bool is_fraction = n <= materials_.materials.size();
      if (value == Interval(1) && is_fraction) {
        ++full;
        which = n - 1;
      } else if (!(value == Interval(0))) {
        settled = false;
      }
    }
    if (settled && full == 1) return fill(tile, materials_.materials[which]);
  }
  program::Program shorter = program::shorten(program, intervals_);
  const Leaf leaf = leaf_for(shorter);
  if (is_leaf(tile, leaf)) return evaluate(std::move(shorter), tile);
  for (const TileBox& half : halves(tile, leaf)) descend(shorter, half);
}

MaterialId* StripEvaluator::voxels(int64_t i, int64_t j, int64_t k) {
  if (!touched_) {
    buffer_->assign(static_cast<size_t>(strip_.voxels()), 0);
    touched_ = true;
  }
  return buffer_->data() + ((k - strip_.lo[2]) * strip_.size(1) + (j - strip_.lo[1])) * strip_.size(0) +
         (i - strip_.lo[0]);
}

void StripEvaluator::fill(const TileBox& tile, MaterialId material) {
  for (int64_t k = tile.lo[2]; k < tile.hi[2]; ++k)
    for (int64_t j = tile.lo[1]; j < tile.hi[1]; ++j) std::fill_n(voxels(tile.lo[0], j, k), tile.size(0), material);
}

void StripEvaluator::evaluate(program::Program program, const TileBox& tile) {
  const size_t early = program::order_for_first(program);
  for (int64_t i = tile.lo[0]; i < tile.hi[0]; ++i)
    xs_[static_cast<size_t>(i - tile.lo[0])] = lattice_.center(i, 0, 0).x;
  for (int64_t k = tile.lo[2]; k < tile.hi[2]; ++k)
    for (int64_t j = tile.lo[1]; j < tile.hi[1]; ++j) evaluate_row(program, early, tile, j, k);
}

void StripEvaluator::evaluate_row(const program::Program& program, size_t early, const TileBox& tile, int64_t j,
                                  int64_t k) {
  const Vec3 p = lattice_.center(tile.lo[0], j, k);
  const eval::SourceRow source_row = [&](const program::Read& read, std::span<double> values) {
    if (!sources_->has(read.tag)) return false;
    sources_->fill(read.tag, tile.lo[0], j, k, values);
    return true;
  };
  rows_.set_row({xs_.data(), static_cast<size_t>(tile.size(0))}, p.y, p.z);
  rows_.run(program, 0, early, source_row);
  const auto inside = rows_.values(program.outputs[0]);
  const auto is_set = [](double v) { return v != 0; };
  const auto first = std::find_if(inside.begin(), inside.end(), is_set);
  if (first == inside.end()) return;
  const auto last = std::find_if(inside.rbegin(), inside.rend(), is_set).base();
  rows_.run(program, early, program.code.size(), source_row);
  quantise_row(program, first - inside.begin(), last - inside.begin(), tile, j, k);
  if (materials_.check_count > 0) count_checks(program, tile, j, k);
}

void StripEvaluator::quantise_row(const program::Program& program, int64_t begin, int64_t end, const TileBox& tile,
                                  int64_t j, int64_t k) {
  const auto inside = rows_.values(program.outputs[0]);
  const size_t count = materials_.materials.size();
  const uint32_t row = row_hash(seed_, j, k);
  MaterialId* out = voxels(tile.lo[0], j, k);
  for (int64_t n = begin; n < end; ++n) {
    const auto at = static_cast<size_t>(n);
    if (inside[at] == 0) continue;
    for (size_t m = 0; m < count; ++m) fractions_[m] = rows_.values(program.outputs[m + 1])[at];
    const size_t chosen =
        dither_ == Dither::threshold ? greatest(fractions_) : pick(fractions_, uniform(row, tile.lo[0] + n));
    out[n] = materials_.materials[chosen];
  }
}

void StripEvaluator::count_checks(const program::Program& program, const TileBox& tile, int64_t j, int64_t k) {
  const auto inside = rows_.values(program.outputs[0]);
  auto& hits = (*checks_)[static_cast<size_t>(k - strip_.lo[2])];
  for (size_t c = 0; c < materials_.check_count; ++c) {
    const auto marks = rows_.values(program.outputs[1 + materials_.materials.size() + c]);
    for (size_t n = 0; n < marks.size(); ++n) {
      if (inside[n] == 0 || marks[n] == 0) continue;
      const std::array<int64_t, 3> voxel{tile.lo[0] + static_cast<int64_t>(n), j, k};
      const auto order = [](const std::array<int64_t, 3>& v) { return std::array{v[2], v[1], v[0]}; };
      if (hits[c].count == 0 || order(voxel) < order(hits[c].first)) hits[c].first = voxel;
      ++hits[c].count;
    }
  }
}

}  // namespace ombre::voxel
