#include "stages/stage_input.h"

#include <algorithm>

namespace ombre::compile {
namespace {

using design::StageValues;

void take_layers(const std::vector<voxel::LayerResult>& layers, StageValues& values, size_t channel) {
  const IndexBox& box = values.box();
  std::vector<MaterialId> row(static_cast<size_t>(box.size(0)));
  auto to = values.channel(channel).begin();
  for (const voxel::LayerResult& layer : layers)
    for (uint32_t j = 0; j < layer.materials().height(); ++j) {
      layer.materials().row(j).unpack(row.data());
      to = std::transform(row.begin(), row.end(), to, [](MaterialId id) { return id != 0 ? 1.0f : 0.0f; });
    }
}

void take_tile(const voxel::FieldTile& tile, size_t output, StageValues& values, size_t channel) {
  const float* from = tile.output(output);
  for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
    for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j) {
      float* const to = values.channel(channel).data() + values.offset(tile.box.lo[0], j, k);
      const auto width = static_cast<size_t>(tile.box.size(0));
      if (tile.is_uniform) {
        std::fill_n(to, width, *from);
      } else {
        std::copy_n(from, width, to);
        from += width;
      }
    }
}

}  // namespace

StageValues StageInput::values(const IndexBox& box, const StopFlag* stop) const {
  StageValues values(box, channels_.size());
  for (size_t n = 0; n < evaluators_.size(); ++n) {
    const Evaluator& evaluator = evaluators_[n];
    if (evaluator.shape) {
      take_layers(evaluator.shape->region(box, stop), values, evaluator.first_channel);
      continue;
    }
    const size_t end = n + 1 < evaluators_.size() ? evaluators_[n + 1].first_channel : channels_.size();
    for (const voxel::FieldTile& tile : evaluator.fields->tiles(box, stop))
      for (size_t c = evaluator.first_channel; c < end; ++c) take_tile(tile, c - evaluator.first_channel, values, c);
  }
  return values;
}

}  // namespace ombre::compile
