#include "base/math/run.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>
#include <utility>

#include "base/math/byte_rows.h"
#include "base/system/assert.h"

namespace ombre {
namespace {

// Up to so many materials are counted, or searched for, by comparing whole rows. With more of them, looking at each
// voxel is as fast.
constexpr size_t most_compared = 6, most_sought = 16;

uint64_t word_at(const MaterialId* voxels) {
  uint64_t word;
  std::memcpy(&word, voxels, sizeof word);
  return word;
}

// The first voxels lie in the low bytes of a word.
static_assert(std::endian::native == std::endian::little);
int equal_from_above(uint64_t differences) { return std::countl_zero(differences) / 8; }

uint64_t repeated(MaterialId material) { return 0x0101010101010101 * uint64_t{material}; }

// Returns the end of the stretch of equal voxels that begins at `from`.
const MaterialId* stretch_end(const MaterialId* from, const MaterialId* end) {
  return from + equal_at_begin({from, end});
}

// Returns the start of the stretch of equal voxels that ends before `end`.
const MaterialId* stretch_begin(const MaterialId* from, const MaterialId* end) {
  const uint64_t pattern = repeated(end[-1]);
  const MaterialId* at = end;
  for (; at - from >= 8; at -= 8)
    if (const uint64_t differences = word_at(at - 8) ^ pattern) return at - equal_from_above(differences);
  while (at != from && at[-1] == end[-1]) --at;
  return at;
}

// Returns the first stretch that is long enough for a run, or an empty one at `end`.
std::span<const MaterialId> find_run(const MaterialId* from, const MaterialId* end) {
  static_assert(RunLayer::shortest_run >= 32);
  for (const MaterialId* at = from;; at += 16) {
    at += find_sixteen_equal({at, end});
    if (end - at < 16) return {end, end};
    const MaterialId* const begin = stretch_begin(from, at + 16);
    const MaterialId* const stop = stretch_end(at, end);
    if (stop - begin >= RunLayer::shortest_run) return {begin, stop};
  }
}

// Counts the voxels of each material in dense stretches.
class VoxelCounter {
 public:
  void count(std::span<const MaterialId> voxels) {
    if (!has_many_ && count_usual(voxels)) return;
    count_any(voxels);
    if (!has_many_) find_usual();
  }
  uint64_t of(MaterialId material) const {
    uint64_t sum = 0;
    for (const auto& table : counts_) sum += table[material];
    return sum;
  }

 private:
  // Returns false and counts nothing if there are materials other than the usual ones.
  bool count_usual(std::span<const MaterialId> voxels) {
    std::array<size_t, most_compared> counts{};
    size_t left = voxels.size();
    for (size_t n = 0; n < usual_.size() && left > 0; ++n) left -= counts[n] = count_equal(voxels, usual_[n]);
    if (left > 0) return false;
    for (size_t n = 0; n < usual_.size(); ++n) counts_[0][usual_[n]] += counts[n];
    return true;
  }

  // Uses eight tables of counters: neighbours are often equal, and repeated additions to one counter would wait for
  // each other.
  void count_any(std::span<const MaterialId> voxels) {
    size_t i = 0;
    for (; i + 8 <= voxels.size(); i += 8)
      for (size_t k = 0; k < 8; ++k) ++counts_[k][voxels[i + k]];
    for (; i < voxels.size(); ++i) ++counts_[0][voxels[i]];
  }

  void find_usual() {
    usual_.clear();
    for (unsigned id = 0; id < 256; ++id)
      if (of(static_cast<MaterialId>(id)) > 0) usual_.push_back(static_cast<MaterialId>(id));
    std::ranges::sort(usual_, std::greater(), [&](MaterialId material) { return of(material); });
    has_many_ = usual_.size() > most_compared;
  }

  std::vector<MaterialId> usual_;  // most frequent first
  bool has_many_ = false;
  std::array<std::array<uint64_t, 256>, 8> counts_{};
};

}  // namespace

void RowView::unpack(MaterialId* out) const {
  const MaterialId* loose = dense.data();
  for (const Run& run : runs) {
    if (run.is_dense) {
      std::memcpy(out, loose, run.length);
      loose += run.length;
    } else {
      std::memset(out, run.material, run.length);
    }
    out += run.length;
  }
}

bool RowView::operator==(const RowView& other) const {
  return std::equal(runs.begin(), runs.end(), other.runs.begin(), other.runs.end()) &&
         std::equal(dense.begin(), dense.end(), other.dense.begin(), other.dense.end());
}

RunLayer::RunLayer(uint32_t width, uint32_t height) : width_(width) {
  dense_.reserve(size_t{width} * height);
  ends_.reserve(height);
}

RowView RunLayer::row(uint32_t j) const {
  const RowEnd begin = row_begin(j), end = ends_[j];
  return {{runs_.data() + begin.runs, end.runs - begin.runs}, {dense_.data() + begin.dense, end.dense - begin.dense}};
}

void RunLayer::add_uniform(MaterialId material, uint32_t count) {
  if (count == 0) return;
  filled_ += count;
  if (material != open_.material) {
    put_open();
    open_ = {material, false, 0};
  }
  open_.length += count;
}

void RunLayer::add(const MaterialId* voxels, uint32_t count) {
  if (count == 0) return;
  const MaterialId *at = stretch_end(voxels, voxels + count), *const end = voxels + count;
  add_uniform(*voxels, static_cast<uint32_t>(at - voxels));
  if (at == end) return;

  // Leaves the last stretch open; the others cannot grow any more.
  put_open();
  filled_ += static_cast<uint32_t>(end - at);
  const MaterialId* const last = stretch_begin(at, end);
  while (at != last) {
    const std::span<const MaterialId> run = find_run(at, last);
    put_dense(at, static_cast<uint32_t>(run.data() - at));
    if (!run.empty()) put_run(run[0], static_cast<uint32_t>(run.size()));
    at = run.data() + run.size();
  }
  open_ = {*last, false, static_cast<uint32_t>(end - last)};
}

void RunLayer::end_row() {
  ASSERT(filled_ == width_);
  put_open();
  open_ = {};
  filled_ = 0;
  ends_.push_back({runs_.size(), dense_.size()});
}

void RunLayer::append_row(const MaterialId* voxels) {
  add(voxels, width_);
  end_row();
}

void RunLayer::append_uniform_row(MaterialId material) {
  add_uniform(material, width_);
  end_row();
}

void RunLayer::put_open() {
  if (open_.length >= shortest_run)
    put_run(open_.material, open_.length);
  else
    put_dense(open_.material, open_.length);
}

void RunLayer::put_run(MaterialId material, uint32_t count) { runs_.push_back({material, false, count}); }

void RunLayer::put_dense(const MaterialId* voxels, uint32_t count) {
  grow_dense(count);
  dense_.insert(dense_.end(), voxels, voxels + count);
}

void RunLayer::put_dense(MaterialId material, uint32_t count) {
  grow_dense(count);
  dense_.insert(dense_.end(), count, material);
}

void RunLayer::grow_dense(uint32_t count) {
  if (count == 0) return;
  const bool continues = runs_.size() > row_begin(ends_.size()).runs && runs_.back().is_dense;
  if (continues)
    runs_.back().length += count;
  else
    runs_.push_back({0, true, count});
}

std::array<uint64_t, 256> count_materials(const RunLayer& layer) {
  std::array<uint64_t, 256> counts{};
  VoxelCounter loose;
  for (uint32_t j = 0; j < layer.height(); ++j) {
    const RowView row = layer.row(j);
    loose.count(row.dense);
    for (const Run& run : row.runs)
      if (!run.is_dense) counts[run.material] += run.length;
  }
  for (size_t id = 0; id < counts.size(); ++id) counts[id] += loose.of(static_cast<MaterialId>(id));
  return counts;
}

void find_materials(const RunLayer& layer, const std::function<bool(MaterialId)>& found) {
  std::vector<MaterialId> known;
  std::array<bool, 256> is_known{};
  const auto goes_on = [&](MaterialId material) {
    if (std::exchange(is_known[material], true)) return true;
    known.push_back(material);
    return found(material);
  };
  for (uint32_t j = 0; j < layer.height(); ++j) {
    const RowView row = layer.row(j);
    for (const Run& run : row.runs)
      if (!run.is_dense && !goes_on(run.material)) return;
    const bool may_be_new = known.size() > most_sought || !are_among(row.dense, known);
    if (may_be_new && !std::ranges::all_of(row.dense, goes_on)) return;
  }
}

}  // namespace ombre
