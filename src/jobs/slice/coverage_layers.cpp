#include "jobs/slice/coverage_layers.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "questions/question.h"
#include "voxel/fields.h"

namespace ombre::compile {
namespace {

using voxel::FieldTile;
using voxel::LayerResult;
using voxel::TileBox;

constexpr int64_t strip_points = 64;  // rows of points that are evaluated at once

int64_t strip_rows(int samples) { return std::max<int64_t>(1, strip_points / samples); }

// Returns a lattice that has a voxel for each point.
voxel::Lattice of_points(voxel::Lattice lattice, int samples) {
  for (const size_t axis : {size_t{0}, size_t{1}}) {
    Pitch& pitch = lattice.pitch[axis];
    pitch = Pitch::from_ratio(pitch.numerator, pitch.denominator * samples).value_or(pitch);
    lattice.count[axis] *= samples;
  }
  return lattice;
}

// The numbers of points inside, for the voxels of a strip of rows through some layers.
class Counts {
 public:
  Counts(const TileBox& box, int samples)
      : box_(box), samples_(samples), counts_(static_cast<size_t>(box.voxels()), 0) {}

  void add(const FieldTile& tile) {
    if (tile.is_uniform && tile.values.front() == 0) return;
    const float* from = tile.output(0);
    for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
      for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j)
        for (int64_t i = tile.box.lo[0]; i < tile.box.hi[0]; ++i) {
          if (*from != 0) ++*voxel(i / samples_, j / samples_, k);
          if (!tile.is_uniform) ++from;
        }
  }

  void append_row(int64_t j, int64_t k, RunLayer& to) {
    const int all = samples_ * samples_;
    std::vector<MaterialId> shades(static_cast<size_t>(box_.size(0)));
    const uint16_t* const row = voxel(box_.lo[0], j, k);
    for (size_t i = 0; i < shades.size(); ++i)
      shades[i] = static_cast<MaterialId>((2 * 255 * row[i] + all) / (2 * all));
    to.append_row(shades.data());
  }

 private:
  uint16_t* voxel(int64_t i, int64_t j, int64_t k) {
    return counts_.data() + ((k - box_.lo[2]) * box_.size(1) + (j - box_.lo[1])) * box_.size(0) + (i - box_.lo[0]);
  }

  TileBox box_;
  int samples_;
  std::vector<uint16_t> counts_;
};

class CoverageLayers {
 public:
  CoverageLayers(program::Program program, const voxel::Lattice& lattice, int samples, voxel::Evaluator evaluator)
      : samples_(samples), fields_(std::move(program), of_points(lattice, samples), evaluator) {}

  std::vector<LayerResult> region(const TileBox& region, const StopFlag* stop) const {
    std::vector<RunLayer> layers(static_cast<size_t>(region.size(2)), RunLayer(static_cast<uint32_t>(region.size(0))));
    for (int64_t j = region.lo[1]; j < region.hi[1]; j += strip_rows(samples_)) {
      if (stop && stop->requested()) throw Cancelled();
      TileBox box = region;
      box.lo[1] = j;
      box.hi[1] = std::min(j + strip_rows(samples_), region.hi[1]);
      append_strip(box, layers, stop);
    }
    std::vector<LayerResult> results(layers.size());
    for (size_t n = 0; n < layers.size(); ++n) results[n].channels.emplace_back(std::move(layers[n]));
    return results;
  }

 private:
  void append_strip(const TileBox& box, std::vector<RunLayer>& layers, const StopFlag* stop) const {
    Counts counts(box, samples_);
    TileBox points = box;
    for (const size_t axis : {size_t{0}, size_t{1}}) {
      points.lo[axis] *= samples_;
      points.hi[axis] *= samples_;
    }
    for (const FieldTile& tile : fields_.tiles(points, stop)) counts.add(tile);
    for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (int64_t j = box.lo[1]; j < box.hi[1]; ++j)
        counts.append_row(j, k, layers[static_cast<size_t>(k - box.lo[2])]);
  }

  int samples_;
  voxel::FieldEvaluator fields_;
};

}  // namespace

voxel::Channel coverage_channel(int samples) {
  voxel::Channel channel{"coverage", voxel::ChannelType::dose8, "", {0, 1}};
  channel.samples = samples;
  return channel;
}

std::optional<RegionProducer> coverage_layers(const design::Design& design, const voxel::Lattice& lattice,
                                              const voxel::Channel& channel, voxel::Evaluator evaluator,
                                              Diagnostics& diagnostics) {
  Question question(design);
  program::Builder& builder = question.builder();
  const program::Field inside = select(question.inside(), builder.constant(1), builder.constant(0));
  auto program = question.program({{channel.name, inside}}, diagnostics);
  if (!program) return std::nullopt;
  const auto layers = std::make_shared<const CoverageLayers>(std::move(*program), lattice, channel.samples, evaluator);
  return [layers](const TileBox& region, const StopFlag* stop) { return layers->region(region, stop); };
}

size_t coverage_working_bytes(const voxel::Channel& channel, const voxel::Lattice& lattice, int64_t layers) {
  const auto of_point = [](int64_t points) { return static_cast<size_t>(points) * sizeof(float); };
  const int64_t rows = std::min(strip_rows(channel.samples), lattice.count[1]);
  const int64_t voxels = lattice.count[0] * rows * layers;
  return of_point(voxels * channel.samples * channel.samples) + static_cast<size_t>(voxels) * sizeof(uint16_t);
}

}  // namespace ombre::compile
