#include "jobs/printable/flag_pieces.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace ombre::compile {
namespace {

constexpr uint32_t no_label = UINT32_MAX;

// Calls `found(begin, end)` for each run of set bits in a row.
template <class Found>
void each_run(const uint64_t* row, int64_t width, const Found& found) {
  const auto next = [&](int64_t from, bool wanted) {
    for (int64_t w = from / 64; w * 64 < width; ++w) {
      uint64_t bits = wanted ? row[w] : ~row[w];
      if (w == from / 64) bits &= ~uint64_t{0} << (from % 64);
      if (bits != 0) return std::min(width, w * 64 + std::countr_zero(bits));
    }
    return width;
  };
  for (int64_t begin = next(0, true); begin < width;) {
    const int64_t end = next(begin, false);
    found(begin, end);
    begin = end < width ? next(end, true) : width;
  }
}

bool is_larger(const FlagPiece& a, const FlagPiece& b) {
  const auto key = [](const FlagPiece& piece) { return std::tuple(~piece.voxels, piece.box.lo, piece.box.hi); };
  return key(a) < key(b);
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

void FlagPieceFinder::add(int64_t k, const BitLayer& layer) {
  Rows rows(static_cast<size_t>(layer.height()));
  for (int64_t j = 0; j < layer.height(); ++j) {
    const auto row = static_cast<size_t>(j);
    each_run(layer.row(j), layer.width(), [&](int64_t begin, int64_t end) {
      Run run{begin, end, no_label};
      if (row < last_.size()) join(last_[row], run);
      if (row > 0) join(rows[row - 1], run);
      if (run.label == no_label) {
        run.label = static_cast<uint32_t>(parents_.size());
        parents_.push_back(run.label);
        pieces_.push_back({0, {{begin, j, k}, {end, j + 1, k + 1}}});
      }
      FlagPiece& piece = pieces_[root(run.label)];
      piece.voxels += static_cast<uint64_t>(end - begin);
      piece.box.lo = {std::min(piece.box.lo[0], begin), std::min(piece.box.lo[1], j), std::min(piece.box.lo[2], k)};
      piece.box.hi = {std::max(piece.box.hi[0], end), std::max(piece.box.hi[1], j + 1),
                      std::max(piece.box.hi[2], k + 1)};
      rows[row].push_back(run);
    });
  }
  close_finished(rows);
  last_ = std::move(rows);
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
        open.push_back(pieces_[root(run.label)]);
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
  largest.insert(std::ranges::upper_bound(largest, piece, is_larger), piece);
  if (largest.size() > most) largest.pop_back();
}

FlagPieces FlagPieceFinder::finish() {
  Rows none;
  close_finished(none);
  last_.clear();
  return std::move(done_);
}

}  // namespace ombre::compile
