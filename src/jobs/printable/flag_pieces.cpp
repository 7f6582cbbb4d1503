#include "jobs/printable/flag_pieces.h"

#include <algorithm>
#include <tuple>

namespace ombre::compile {
namespace {

constexpr uint32_t no_label = UINT32_MAX;

bool is_larger(const FlagPiece& a, const FlagPiece& b) {
  const auto key = [](const FlagPiece& piece) { return std::tuple(~piece.voxels, piece.box.lo, piece.box.hi); };
  return key(a) < key(b);
}

bool has_any(const BitLayer& layer, int64_t j, int64_t begin, int64_t end) {
  const uint64_t* const row = layer.row(j);
  for (int64_t w = begin / 64; w * 64 < end; ++w) {
    uint64_t bits = row[w];
    if (w == begin / 64) bits &= ~uint64_t{0} << (begin % 64);
    if (w == end / 64) bits &= (uint64_t{1} << (end % 64)) - 1;
    if (bits != 0) return true;
  }
  return false;
}

}  // namespace

uint32_t FlagPieceFinder::root(uint32_t label) {
  while (parents_[label] != label) label = parents_[label] = parents_[parents_[label]];
  return label;
}

void FlagPieceFinder::merge(uint32_t a, uint32_t b) {
  a = root(a), b = root(b);
  if (a == b) return;
  FlagPiece &kept = pieces_[a], &other = pieces_[b];
  kept.voxels += other.voxels;
  kept.is_pinned = kept.is_pinned || other.is_pinned;
  if (kept.voxels > kept_voxels_)
    kept.runs.clear();
  else
    kept.runs.insert(kept.runs.end(), other.runs.begin(), other.runs.end());
  other.runs = {};
  for (size_t axis = 0; axis < 3; ++axis) {
    kept.box.lo[axis] = std::min(kept.box.lo[axis], other.box.lo[axis]);
    kept.box.hi[axis] = std::max(kept.box.hi[axis], other.box.hi[axis]);
  }
  parents_[b] = a;
}

// Joins a run with those of a neighbouring row that touch it.
void FlagPieceFinder::join(const std::vector<Run>& before, Run& run) {
  const auto first = std::ranges::partition_point(before, [&](const Run& other) { return other.end <= run.begin; });
  for (auto other = first; other != before.end() && other->begin < run.end; ++other)
    if (run.label == no_label)
      run.label = root(other->label);
    else
      merge(run.label, other->label);
}

// Keeps a run that the piece has got.
void FlagPieceFinder::keep(FlagPiece& piece, const FlagRun& run) const {
  if (piece.voxels > kept_voxels_)
    piece.runs = {};
  else
    piece.runs.push_back(run);
}

void FlagPieceFinder::add(int64_t k, const BitLayer& layer, const BitLayer* pins) {
  width_ = layer.width();
  Rows rows(static_cast<size_t>(layer.height()));
  for (int64_t j = 0; j < layer.height(); ++j) {
    const auto row = static_cast<size_t>(j);
    each_run(layer, j, [&](int64_t begin, int64_t end) {
      Run run{begin, end, no_label};
      if (row < last_.size()) join(last_[row], run);
      if (row > 0) join(rows[row - 1], run);
      if (run.label == no_label) {
        run.label = static_cast<uint32_t>(parents_.size());
        parents_.push_back(run.label);
        pieces_.push_back({0, {{begin, j, k}, {end, j + 1, k + 1}}, false, {}});
      }
      FlagPiece& piece = pieces_[root(run.label)];
      piece.voxels += static_cast<uint64_t>(end - begin);
      piece.is_pinned = piece.is_pinned || (pins && has_any(*pins, j, begin, end));
      keep(piece, {k, j, begin, end});
      piece.box.lo = {std::min(piece.box.lo[0], begin), std::min(piece.box.lo[1], j), std::min(piece.box.lo[2], k)};
      piece.box.hi = {std::max(piece.box.hi[0], end), std::max(piece.box.hi[1], j + 1),
                      std::max(piece.box.hi[2], k + 1)};
      rows[row].push_back(run);
    });
  }
  close_finished(rows);
  last_ = std::move(rows);
}

BitLayer FlagPieceFinder::last_where(const Counts& holds) {
  BitLayer layer(width_, static_cast<int64_t>(last_.size()));
  for (size_t row = 0; row < last_.size(); ++row)
    for (const Run& run : last_[row])
      if (holds(pieces_[root(run.label)])) layer.set(static_cast<int64_t>(row), run.begin, run.end);
  return layer;
}

// Closes pieces that do not reach the layer, and numbers the others anew.
void FlagPieceFinder::close_finished(Rows& rows) {
  std::vector<uint32_t> number(parents_.size(), no_label);
  std::vector<FlagPiece> open;
  for (std::vector<Run>& row : rows)
    for (Run& run : row) {
      uint32_t& at = number[root(run.label)];
      if (at == no_label) {
        at = static_cast<uint32_t>(open.size());
        open.push_back(std::move(pieces_[root(run.label)]));
      }
      run.label = at;
    }
  for (uint32_t label = 0; label < parents_.size(); ++label)
    if (parents_[label] == label && number[label] == no_label) close(pieces_[label]);
  pieces_ = std::move(open);
  parents_.resize(pieces_.size());
  for (uint32_t label = 0; label < parents_.size(); ++label) parents_[label] = label;
}

void FlagPieceFinder::close(const FlagPiece& piece) {
  if (counts_ && !counts_(piece)) return;
  ++done_.count;
  done_.voxels += piece.voxels;
  std::vector<FlagPiece>& largest = done_.largest;
  const FlagPiece plain{piece.voxels, piece.box, piece.is_pinned, {}};
  largest.insert(std::ranges::upper_bound(largest, plain, is_larger), plain);
  if (largest.size() > most) largest.pop_back();
}

FlagPieces FlagPieceFinder::finish() {
  Rows none;
  close_finished(none);
  last_.clear();
  return std::move(done_);
}

}  // namespace ombre::compile
