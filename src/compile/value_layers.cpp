#include "compile/value_layers.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "compile/question.h"
#include "compile/region_survey.h"
#include "voxel/fields.h"

namespace ombre::compile {
namespace {

using program::Field;
using voxel::FieldTile;
using voxel::LayerResult;
using voxel::TileBox;

constexpr int64_t strip_rows = 64;  // that are evaluated at once

// Outside, and where the value is no number, black.
Field shade_of(Question& question, Field value, Interval range) {
  program::Builder& builder = question.builder();
  const double width = range.hi > range.lo ? range.hi - range.lo : 1;
  const Field share = min(max((value - range.lo) * (1 / width), 0.0), builder.constant(1));
  return select(logical_and(question.inside(), is_finite(value)), share * 255.0, builder.constant(0));
}

MaterialId shade(float value) { return static_cast<MaterialId>(std::lround(value)); }

// The shades of a strip of rows through some layers.
class Strip {
 public:
  explicit Strip(const TileBox& box) : box_(box), shades_(static_cast<size_t>(box.voxels())) {}

  void take(const FieldTile& tile) {
    const float* from = tile.output(0);
    for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
      for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j) {
        MaterialId* to = row(j, k) + (tile.box.lo[0] - box_.lo[0]);
        for (int64_t i = tile.box.lo[0]; i < tile.box.hi[0]; ++i, ++to) {
          *to = shade(*from);
          if (!tile.is_uniform) ++from;
        }
      }
  }

  MaterialId* row(int64_t j, int64_t k) {
    return shades_.data() + ((k - box_.lo[2]) * box_.size(1) + (j - box_.lo[1])) * box_.size(0);
  }

 private:
  TileBox box_;
  std::vector<MaterialId> shades_;
};

std::vector<LayerResult> layers_of(const voxel::FieldEvaluator& evaluator, const TileBox& region,
                                   const StopFlag* stop) {
  std::vector<LayerResult> layers(static_cast<size_t>(region.size(2)));
  for (LayerResult& layer : layers) layer.runs = RunLayer(static_cast<uint32_t>(region.size(0)));
  for (int64_t j = region.lo[1]; j < region.hi[1]; j += strip_rows) {
    if (stop && stop->requested()) throw Cancelled();
    TileBox box = region;
    box.lo[1] = j;
    box.hi[1] = std::min(j + strip_rows, region.hi[1]);
    Strip strip(box);
    for (const FieldTile& tile : evaluator.tiles(box, stop)) strip.take(tile);
    for (int64_t k = region.lo[2]; k < region.hi[2]; ++k)
      for (int64_t row = box.lo[1]; row < box.hi[1]; ++row)
        layers[static_cast<size_t>(k - region.lo[2])].runs.append_row(strip.row(row, k));
  }
  for (LayerResult& layer : layers) layer.material_counts = count_materials(layer.runs);
  return layers;
}

}  // namespace

std::optional<ShadeMeaning> shade_meaning(const design::Design& design, const Box& box, const ValueChoice& choice,
                                          Diagnostics& diagnostics) {
  ShadeMeaning meaning{choice.of, value_unit(design, choice.of), choice.range.value_or(Interval(0, 1))};
  const size_t errors = diagnostics.error_count();
  const bool is_fraction = design.materials.find(choice.of) != nullptr;
  if (!choice.range && !is_fraction)
    if (const auto found = value_range(design, box, choice.of, diagnostics)) meaning.range = *found;
  if (diagnostics.error_count() > errors) return std::nullopt;
  return meaning;
}

std::optional<RegionProducer> value_layers(const design::Design& design, const voxel::Lattice& lattice,
                                           const ShadeMeaning& meaning, voxel::Evaluator evaluator,
                                           Diagnostics& diagnostics) {
  Question question(design);
  const auto value = question.value(meaning.of, diagnostics);
  if (!value) return std::nullopt;
  auto program = question.program({{meaning.of, shade_of(question, *value, meaning.range)}}, diagnostics);
  if (!program) return std::nullopt;
  auto fields = std::make_shared<const voxel::FieldEvaluator>(std::move(*program), lattice, evaluator);
  return [fields](const TileBox& region, const StopFlag* stop) { return layers_of(*fields, region, stop); };
}

std::vector<SliceMaterial> value_shades() {
  std::vector<SliceMaterial> shades;
  for (int n = 1; n < 256; ++n) {
    const auto gray = static_cast<uint8_t>(n);
    shades.push_back({"gray " + std::to_string(n), gray, {gray, gray, gray, 255}});
  }
  return shades;
}

}  // namespace ombre::compile
