// Estimates a slice job from a few of its layers.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "base/system/stopwatch.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "jobs/slice/forecast.h"
#include "jobs/slice/layer_files.h"
#include "jobs/slice/slice.h"
#include "jobs/slice/slice_work.h"

namespace ombre::compile {
namespace {

constexpr size_t most_sampled_slabs = 64;
// After most_seconds no slab is begun, after deadline_seconds none continues.
constexpr double most_seconds = 2, deadline_seconds = 4;
// Times of writing to an idle disk.
constexpr double seconds_for_a_file = 50e-6, seconds_for_a_byte = 1 / 1.5e9;

double guess_writing_seconds(const SliceRequest& request, LayerRange range, double bytes) {
  const auto files = static_cast<double>(LayerFiles(request).names(0).size());
  return static_cast<double>(range.end - range.begin) * files * seconds_for_a_file + bytes * seconds_for_a_byte;
}

// A piece of the layers of a slab: some rows, over the whole width.
struct RowPiece {
  LayerRange slab, layers;  // `layers` are some of the slab's
  int64_t first_row = 0, rows = 0;
};

struct Sample {
  LayerRange slab;
  LayerCost cost;  // cost of the slab, if the piece is like the rest of it
  std::vector<LayerEntry> layers;
};

// Returns about the bytes that a layer's files take beside its rows.
double bytes_without_rows(const SliceRequest& request, const exporting::ImageStack& stack) {
  std::vector<voxel::ChannelPixels> row;
  for (const voxel::Channel& channel : request.channels)
    row.push_back(voxel::blank_pixels(channel.type, static_cast<uint32_t>(request.lattice.count[0]), 1));
  double bytes = 0;
  for (const std::string& image : encode_layer(request, row, stack)) bytes += static_cast<double>(image.size());
  return bytes;
}

// Makes samples of pieces of layers.
class PieceMaker {
 public:
  PieceMaker(const SliceRequest& request, const RegionProducer& regions)
      : request_(request), regions_(regions), fixed_bytes_(bytes_without_rows(request, stack_)) {}

  Sample take(const RowPiece& piece, const StopFlag* stop) const {
    const int64_t width = request_.lattice.count[0], height = request_.lattice.count[1];
    const LayerProducer producer = [&](int64_t begin, int64_t end, const StopFlag* stopped) {
      return regions_({{0, piece.first_row, begin}, {width, piece.first_row + piece.rows, end}}, stopped);
    };
    const double of_rows = static_cast<double>(height) / static_cast<double>(piece.rows);
    const double of_layers = static_cast<double>(piece.slab.end - piece.slab.begin) /
                             static_cast<double>(piece.layers.end - piece.layers.begin);
    Sample sample;
    sample.slab = piece.slab;
    const Stopwatch watch;
    for (EncodedLayer& layer : make_slab(request_, producer, stack_, piece.layers, stop)) {
      if (!layer.images.empty())
        sample.cost.bytes += of_layers * (fixed_bytes_ + of_rows * (static_cast<double>(layer.bytes()) - fixed_bytes_));
      sample.layers.push_back(std::move(layer.entry));
    }
    sample.cost.seconds = of_layers * of_rows * watch.seconds();
    return sample;
  }

 private:
  const SliceRequest& request_;
  const RegionProducer& regions_;
  const exporting::ImageStack stack_ = image_stack(request_);
  const double fixed_bytes_;
};

// Chooses pieces to sample: slabs as they will be made, or parts of them if a slab takes too long for several to be
// sampled in time.
class RowPieces {
 public:
  RowPieces(const SliceRequest& request, std::vector<LayerRange> slabs)
      : height_(request.lattice.count[1]), slabs_(std::move(slabs)) {}

  size_t count() const { return slabs_.size(); }

  // Returns a piece; the rows of different pieces are evenly spread.
  RowPiece at(size_t n) const {
    const LayerRange slab = slabs_[n];
    const int64_t middle = (slab.begin + slab.end) / 2, rows = std::min(shape_.rows, height_);
    constexpr double step = 0.7548776662466927;  // irrational, and unlike the step between slabs
    const double place = 0.5 + static_cast<double>(n) * step;
    const auto first = static_cast<int64_t>((place - std::floor(place)) * static_cast<double>(height_ - rows + 1));
    return {slab, shape_.has_all_layers ? slab : LayerRange{middle, middle + 1}, first, rows};
  }

  // Chooses larger pieces while these can be made in time. `seconds` returns the time that one took, or nothing if that
  // was too long.
  void grow(const std::function<std::optional<double>(const RowPiece&)>& seconds) {
    if (slabs_.empty()) return;
    seconds(at(0));  // warms the caches
    const Shape shapes[] = {{false, 64}, {true, 64}, {true, 512}, {true, height_}};
    for (const Shape& larger : shapes) {
      const std::optional<double> took = seconds(at(0));
      if (!took || *took * rows_in(larger) / rows_in(shape_) > most_seconds_of_piece) return;
      shape_ = larger;
    }
  }

 private:
  struct Shape {
    bool has_all_layers = false;  // all layers of the slab, or only one
    int64_t rows = 8;
  };
  static constexpr double most_seconds_of_piece = 0.3;

  double rows_in(const Shape& shape) const {
    const int64_t layers = shape.has_all_layers ? slabs_[0].end - slabs_[0].begin : 1;
    return static_cast<double>(layers * std::min(shape.rows, height_));
  }

  int64_t height_;
  std::vector<LayerRange> slabs_;
  Shape shape_;
};

// Results of checks in samples, by layer.
class SampledChecks {
 public:
  void add(const Sample& sample) {
    for (const LayerEntry& entry : sample.layers) layers_[entry.layer] = entry.checks;
  }
  std::vector<CheckReport> reports(const SliceRequest& request) const {
    CheckSums sums(request);
    for (const auto& [layer, checks] : layers_) sums.add(checks);
    return sums.reports();
  }

 private:
  std::map<int64_t, std::vector<voxel::CheckHits>> layers_;
};

// Follows the progress of stages that take longer than an estimate may.
class StagePace final : public Progress {
 public:
  void update(const HowFar&) override {}
  void preparing(const std::string&, const HowFar& how_far) override {
    if (how_far.seconds_left >= 0) seconds_ = watch_.seconds() + how_far.seconds_left;
  }
  // Returns nothing while too little is known.
  std::optional<double> seconds() const { return seconds_; }

 private:
  Stopwatch watch_;
  std::optional<double> seconds_;
};

struct StageEstimate {
  double seconds = 0;
  bool is_least = false;
};

// Estimates stages. Those that are not ready in time are left out of the layers.
StageEstimate estimate_stages(const SliceOptions& options, const StopFlag* stop) {
  if (!options.stages || options.stages->is_prepared()) return {};
  const Stopwatch watch;
  const StopFlag deadline(stop, most_seconds);
  StagePace pace;
  StageEstimate estimate;
  try {
    options.stages->prepare(stage_loan(options, &pace, &deadline));
    estimate.seconds = watch.seconds();
  } catch (const Cancelled&) {
    if (stop && stop->requested()) throw;
    options.stages->leave_out_unprepared();
    estimate = {pace.seconds().value_or(watch.seconds()), !pace.seconds()};
  }
  options.stages->lend(stage_loan(options, nullptr, stop));
  return estimate;
}

}  // namespace

SliceEstimate estimate_slice(const SliceRequest& request, const RegionProducer& regions, const SliceOptions& whole,
                             const StopFlag* stop) {
  const StageEstimate stages = estimate_stages(whole, stop);
  const SliceOptions options = without_stages_memory(whole);
  const LayerRange range = options.layers.value_or(LayerRange{0, request.lattice.count[2]});
  const WorkSize size = size_work(request, options);
  const PieceMaker maker(request, regions);
  const std::vector<LayerRange> slabs = spread(missing_slabs(range, {}, size.slab_layers), most_sampled_slabs);
  RowPieces pieces(request, slabs);

  const Stopwatch watch;
  const StopFlag deadline(stop, deadline_seconds);
  const auto look_at = [&](const RowPiece& piece) -> std::optional<Sample> {
    try {
      Sample sample = maker.take(piece, &deadline);
      if (!deadline.requested()) return sample;
    } catch (const Cancelled&) {
    }
    return std::nullopt;
  };
  pieces.grow([&](const RowPiece& piece) -> std::optional<double> {
    const Stopwatch one;
    return look_at(piece) ? std::optional(one.seconds()) : std::nullopt;
  });

  CostProfile profile;
  SampledChecks checks;
  // Each thread samples the first piece to warm its caches; that piece is then sampled again.
  const auto first = slabs.empty() ? size_t{0} : static_cast<size_t>(size.threads);
  const auto produce = [&](size_t i) -> std::optional<Sample> {
    if (i > 0 && watch.seconds() > most_seconds) return std::nullopt;
    return look_at(pieces.at(i < first ? 0 : i - first));
  };
  const auto consume = [&](size_t, const std::optional<Sample>& sample) {
    if (!sample) return;
    profile.add(sample->slab, sample->cost);
    checks.add(*sample);
  };
  run_ordered<std::optional<Sample>>(first + pieces.count(), size.threads, size.window, produce, consume);
  if (stop && stop->requested()) throw Cancelled();

  SliceEstimate estimate;
  const bool is_unknown = profile.is_empty() && !slabs.empty();
  estimate.is_least = is_unknown || stages.is_least;
  if (is_unknown) profile.add(slabs[0], {watch.seconds(), 0});
  const LayerCost cost = profile.of(range);
  estimate.seconds =
      stages.seconds + wall_seconds(cost.seconds, guess_writing_seconds(request, range, cost.bytes), size.threads);
  estimate.bytes = static_cast<uint64_t>(cost.bytes);
  estimate.memory_bytes = size.memory_bytes + (whole.memory_bytes - options.memory_bytes);
  estimate.checks = checks.reports(request);
  estimate.costs = std::move(profile);
  return estimate;
}

}  // namespace ombre::compile
