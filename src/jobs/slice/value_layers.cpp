#include "jobs/slice/value_layers.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "base/text/error.h"
#include "questions/question.h"
#include "questions/region_survey.h"
#include "voxel/fields.h"

namespace ombre::compile {
namespace {

using program::Field;
using voxel::FieldTile;
using voxel::LayerResult;
using voxel::TileBox;

constexpr int64_t strip_rows = 64;  // rows that are evaluated at once

// Returns the shade; it is black outside, and where the value is no number.
Field shade_of(Question& question, Field value, const ShadeMeaning& meaning) {
  program::Builder& builder = question.builder();
  const Interval& range = meaning.range;
  const double width = range.hi > range.lo ? range.hi - range.lo : 1, last = meaning.bits == 16 ? 65535 : 255;
  const Field share = min(max((value - range.lo) * (1 / width), 0.0), builder.constant(1));
  return select(logical_and(question.inside(), is_finite(value)), share * last, builder.constant(0));
}

// The shades of a strip of rows through some layers.
class Strip {
 public:
  explicit Strip(const TileBox& box) : box_(box), shades_(static_cast<size_t>(box.voxels())) {}

  void take(const FieldTile& tile) {
    const float* from = tile.output(0);
    for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
      for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j) {
        uint16_t* to = row(j, k) + (tile.box.lo[0] - box_.lo[0]);
        for (int64_t i = tile.box.lo[0]; i < tile.box.hi[0]; ++i, ++to) {
          *to = static_cast<uint16_t>(std::lround(*from));
          if (!tile.is_uniform) ++from;
        }
      }
  }

  uint16_t* row(int64_t j, int64_t k) {
    return shades_.data() + ((k - box_.lo[2]) * box_.size(1) + (j - box_.lo[1])) * box_.size(0);
  }

 private:
  TileBox box_;
  std::vector<uint16_t> shades_;
};

void append_row(std::span<const uint16_t> shades, int shift, RunLayer& to) {
  std::vector<MaterialId> bytes(shades.size());
  std::ranges::transform(shades, bytes.begin(), [&](uint16_t s) { return static_cast<MaterialId>(s >> shift); });
  to.append_row(bytes.data());
}

void append_row(std::span<const uint16_t> shades, LayerResult& layer) {
  if (!layer.lower_bytes) return append_row(shades, 0, layer.runs);
  append_row(shades, 8, layer.runs);
  append_row(shades, 0, *layer.lower_bytes);
  for (const uint16_t shade : shades)
    if (shade > 0) ++layer.material_counts[std::max<size_t>(1, shade >> 8)];
}

std::vector<LayerResult> layers_of(const voxel::FieldEvaluator& evaluator, const TileBox& region, int bits,
                                   const StopFlag* stop) {
  const auto width = static_cast<uint32_t>(region.size(0));
  std::vector<LayerResult> layers(static_cast<size_t>(region.size(2)));
  for (LayerResult& layer : layers) {
    layer.runs = RunLayer(width);
    if (bits == 16) layer.lower_bytes = RunLayer(width);
  }
  for (int64_t j = region.lo[1]; j < region.hi[1]; j += strip_rows) {
    if (stop && stop->requested()) throw Cancelled();
    TileBox box = region;
    box.lo[1] = j;
    box.hi[1] = std::min(j + strip_rows, region.hi[1]);
    Strip strip(box);
    for (const FieldTile& tile : evaluator.tiles(box, stop)) strip.take(tile);
    for (int64_t k = region.lo[2]; k < region.hi[2]; ++k)
      for (int64_t row = box.lo[1]; row < box.hi[1]; ++row)
        append_row({strip.row(row, k), width}, layers[static_cast<size_t>(k - region.lo[2])]);
  }
  for (LayerResult& layer : layers)
    if (!layer.lower_bytes) layer.material_counts = count_materials(layer.runs);
  return layers;
}

}  // namespace

std::optional<ShadeMeaning> shade_meaning(const design::Design& design, const Box& box, const ValueChoice& choice,
                                          Diagnostics& diagnostics) {
  ShadeMeaning meaning{choice.of, value_unit(design, choice.of), choice.range.value_or(Interval(0, 1)), choice.bits};
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
  auto program = question.program({{meaning.of, shade_of(question, *value, meaning)}}, diagnostics);
  if (!program) return std::nullopt;
  auto fields = std::make_shared<const voxel::FieldEvaluator>(std::move(*program), lattice, evaluator);
  return [fields, bits = meaning.bits](const TileBox& region, const StopFlag* stop) {
    return layers_of(*fields, region, bits, stop);
  };
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
