// A solid that is smoothed by a filter without changing its volume.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

#include "base/system/tasks.h"
#include "nodes/common/whole_stages.h"

namespace ombre::nodes {
namespace {

using design::StageValues;

// Computes the filter's sums over all cells. Beyond the cells everything is outside. Cells are processed in slabs.
class FilteredCells {
 public:
  FilteredCells(const LinearFilter& filter, const StageValues& read, std::vector<float>& sums)
      : filter_(filter), read_(read), sums_(sums), box_(read.box()) {}

  void run(const design::StageWork& work) {
    const int64_t layers = slab_layers();
    const auto slabs = static_cast<size_t>((box_.size(2) + layers - 1) / layers);
    std::mutex mutex;
    size_t done = 0;
    run_parallel(slabs, work.threads, [&](size_t n) {
      const int64_t begin = box_.lo[2] + static_cast<int64_t>(n) * layers;
      make(begin, std::min(begin + layers, box_.hi[2]), work.stop);
      const std::scoped_lock lock(mutex);
      work.tell(0.9 * static_cast<double>(++done) / static_cast<double>(slabs));
    });
  }

 private:
  // Returns the thickness of a slab, chosen so that the layers read around it are no more than the slab itself.
  int64_t slab_layers() const {
    constexpr int64_t least = 8;
    return std::max(least, filter_.below()[2] + filter_.above()[2]);
  }

  void make(int64_t begin, int64_t end, const StopFlag* stop) {
    const auto below = filter_.below(), above = filter_.above();
    NumberGrid grid;
    grid.size = {box_.size(0) + below[0] + above[0], box_.size(1) + below[1] + above[1],
                 end - begin + below[2] + above[2]};
    grid.values.resize(static_cast<size_t>(grid.size[0] * grid.size[1] * grid.size[2]));
    const std::vector<float>& inside = read_.channel(0);
    for (int64_t k = std::max(begin - below[2], box_.lo[2]); k < std::min(end + above[2], box_.hi[2]); ++k)
      for (int64_t j = 0; j < box_.size(1); ++j) {
        design::check_stop(stop);
        const auto row = inside.begin() + static_cast<ptrdiff_t>(read_.offset(box_.lo[0], box_.lo[1] + j, k));
        const int64_t to = ((k - begin + below[2]) * grid.size[1] + j + below[1]) * grid.size[0] + below[0];
        std::copy(row, row + box_.size(0), grid.values.begin() + to);
      }
    const NumberGrid made = filter_.apply(grid, stop);
    const auto first = static_cast<ptrdiff_t>(read_.offset(box_.lo[0], box_.lo[1], begin));
    std::ranges::transform(made.values, sums_.begin() + first, [](double sum) { return static_cast<float>(sum); });
  }

  const LinearFilter& filter_;
  const StageValues& read_;
  std::vector<float>& sums_;
  const IndexBox box_;
};

// Returns the value with the given rank in descending order; rank 0 is the greatest. No value may be negative.
float ranked_value(const std::vector<float>& values, size_t rank) {
  // Bits of non-negative floats sort like the floats: finds the upper half of the bits first, then the lower.
  constexpr uint32_t half = 16, lowest = (1U << half) - 1;
  uint32_t upper = 0;
  for (const bool is_lower : {false, true}) {
    std::vector<size_t> counts(size_t{1} << half);
    for (const float value : values) {
      const auto bits = std::bit_cast<uint32_t>(value);
      if (!is_lower) ++counts[bits >> half];
      if (is_lower && bits >> half == upper) ++counts[bits & lowest];
    }
    uint32_t bucket = lowest;
    for (; bucket > 0 && counts[bucket] <= rank; --bucket) rank -= counts[bucket];
    if (is_lower) return std::bit_cast<float>(upper << half | bucket);
    upper = bucket;
  }
  return 0;
}

// Returns a level above which lie `wanted` values, or as close to that number as equal values allow. No value equals
// the level.
float level_above(const std::vector<float>& values, size_t wanted) {
  const float last = ranked_value(values, wanted - 1);
  size_t above = 0, equal = 0;
  float lower = 0, higher = std::numeric_limits<float>::max();
  for (const float value : values) {
    above += value > last ? 1 : 0;
    equal += value == last ? 1 : 0;
    if (value < last) lower = std::max(lower, value);
    if (value > last) higher = std::min(higher, value);
  }
  const bool takes_equal = above + equal - wanted <= wanted - above;
  return takes_equal ? std::midpoint(lower, last) : std::midpoint(last, higher);
}

class KeptVolumeStage final : public design::WholeStage {
 public:
  KeptVolumeStage(const design::NodePtr& solid, const KeptVolumeUse& use, std::string key,
                  std::function<LinearFilter(Vec3)> filter)
      : solid_(solid), use_(use), key_(std::move(key)), filter_(std::move(filter)) {}

  std::string name() const override { return "smooth"; }
  Hash content() const override { return hash_bytes("kept volume " + key_); }
  Box bounds() const override {
    const Box box = solid_->bounds(design::design_space());
    return box.is_empty() ? box : box.expanded(use_.margin_mm);
  }
  design::LatticeChoice lattice() const override { return {use_.cell_mm, false}; }
  double bytes_of_cell() const override { return 0; }
  std::vector<design::StageRead> reads() const override { return {{.solid = solid_, .inside = true}}; }
  std::vector<design::StageChannel> channels(const std::vector<design::StageChannel>&) const override {
    return {{"share", {}, 0, false, {-1, 2}}};
  }

  void compute(const StageValues& read, StageValues& made, const design::StageLattice& lattice,
               const design::StageWork& work) const override {
    const auto cells_inside =
        static_cast<size_t>(std::ranges::count_if(read.channel(0), [](float v) { return v != 0; }));
    if (cells_inside == 0) return;
    std::vector<float>& share = made.channel(0);
    const Vec3 cell_mm{lattice.pitch[0].mm(), lattice.pitch[1].mm(), lattice.pitch[2].mm()};
    FilteredCells(filter_(cell_mm), read, share).run(work);
    const float level = level_above(share, cells_inside);
    constexpr float half = 0.5f;
    const float inside = std::nextafter(half, 1.0f), outside = std::nextafter(half, 0.0f);
    for (float& value : share) {
      const float moved = value + (half - level);
      value = value > level ? std::max(moved, inside) : std::min(moved, outside);
    }
  }

 private:
  design::NodePtr solid_;
  KeptVolumeUse use_;
  std::string key_;
  std::function<LinearFilter(Vec3)> filter_;
};

}  // namespace

design::StagePtr make_kept_volume_stage(const design::NodePtr& solid, const KeptVolumeUse& use, const std::string& key,
                                        std::function<LinearFilter(Vec3 cell_mm)> filter) {
  return std::make_shared<KeptVolumeStage>(solid, use, key, std::move(filter));
}

}  // namespace ombre::nodes
