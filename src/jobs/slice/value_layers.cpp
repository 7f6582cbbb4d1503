#include "jobs/slice/value_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>

#include "base/text/error.h"
#include "base/text/text.h"
#include "design/attributes.h"
#include "jobs/slice/coverage_layers.h"
#include "questions/question.h"
#include "questions/region_survey.h"
#include "voxel/fields.h"

namespace ombre::compile {
namespace {

using program::Field;
using voxel::Channel;
using voxel::ChannelPixels;
using voxel::ChannelType;
using voxel::Colour;
using voxel::FieldTile;
using voxel::LayerResult;
using voxel::Raster;
using voxel::TileBox;

constexpr int64_t strip_rows = 64;  // rows that are evaluated at once

// Returns whether the design declares a colour of that name. Materials come first.
bool is_colour(const design::Design& design, const std::string& name) {
  if (design.materials.find(name)) return false;
  return std::ranges::any_of(declared_attributes(design), [&](const design::AttributeDeclaration& attribute) {
    return attribute.name == name && attribute.type == design::ValueType::colour;
  });
}

// Returns the number of numbers that a voxel of the channel has.
size_t numbers_of(const Channel& channel) { return channel.type == ChannelType::colour ? Colour().size() : 1; }

// Returns the place of a number in a range as one of the whole numbers from 0 to `last`, before it is rounded; 0
// outside and where the number is undefined.
Field place_in(const Interval& range, int last, Field number, Question& question) {
  program::Builder& builder = question.builder();
  const double width = range.hi > range.lo ? range.hi - range.lo : 1;
  const Field share = min(max((number - range.lo) * (1 / width), 0.0), builder.constant(1));
  return select(logical_and(question.inside(), is_finite(number)), share * last, builder.constant(0));
}

// Adds outputs that are 1 where the numbers of a channel lie below its range, and above it, by more than rounding.
bool add_beyond(const Channel& channel, Question& question, program::Outputs& outputs, Diagnostics& diagnostics) {
  constexpr double share = 1e-5, precision = 1e-6;  // of the range, and of floats
  const Interval& range = channel.range;
  const double slack = share * (range.hi - range.lo) + precision * std::max(std::abs(range.lo), std::abs(range.hi));
  const auto number = question.value(channel.name, diagnostics);
  if (!number) return false;
  program::Builder& builder = question.builder();
  const Field counts = logical_and(question.inside(), is_finite(*number));
  const auto add = [&](const Field& is_beyond) {
    outputs.emplace_back(channel.name,
                         select(logical_and(counts, is_beyond), builder.constant(1), builder.constant(0)));
  };
  add(*number < range.lo - slack);
  add(less(builder.constant(range.hi + slack), *number));
  return true;
}

// Adds the outputs of a channel. Returns false, and adds a diagnostic, when the design has no such value.
bool add_outputs(const Channel& channel, Question& question, program::Outputs& outputs, Diagnostics& diagnostics) {
  const bool is_colour = channel.type == ChannelType::colour;
  const int last = is_colour ? 255 : voxel::channel_kind(channel.type).last_shade;
  for (const std::string& name :
       is_colour ? attribute_parts(question.design(), channel.name) : std::vector{channel.name}) {
    const auto number = question.value(name, diagnostics);
    if (!number) return false;
    outputs.emplace_back(name, place_in(channel.range, last, *number, question));
  }
  return true;
}

// The numbers of a strip of rows through some layers, output after output.
class Strip {
 public:
  Strip(const TileBox& box, size_t outputs)
      : box_(box), voxels_(static_cast<size_t>(box.voxels())), numbers_(outputs * voxels_) {}

  void take(const FieldTile& tile) {
    for (size_t output = 0; output * voxels_ < numbers_.size(); ++output) {
      const float* from = tile.output(output);
      for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
        for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j) {
          uint16_t* to = begin_of(output, j, k) + (tile.box.lo[0] - box_.lo[0]);
          for (int64_t i = tile.box.lo[0]; i < tile.box.hi[0]; ++i, ++to) {
            *to = static_cast<uint16_t>(std::lround(*from));
            if (!tile.is_uniform) ++from;
          }
        }
    }
  }

  std::span<const uint16_t> row(size_t output, int64_t j, int64_t k) {
    return {begin_of(output, j, k), static_cast<size_t>(box_.size(0))};
  }

 private:
  uint16_t* begin_of(size_t output, int64_t j, int64_t k) {
    return numbers_.data() + output * voxels_ + ((k - box_.lo[2]) * box_.size(1) + (j - box_.lo[1])) * box_.size(0);
  }

  TileBox box_;
  size_t voxels_;
  std::vector<uint16_t> numbers_;
};

// Appends a row of a strip to the pixels of a channel whose first output is given.
struct RowAppender {
  Strip& strip;
  size_t output;
  int64_t j, k;

  void operator()(RunLayer& to) const {
    const auto shades = strip.row(output, j, k);
    std::vector<MaterialId> bytes(shades.size());
    std::ranges::transform(shades, bytes.begin(), [](uint16_t shade) { return static_cast<MaterialId>(shade); });
    to.append_row(bytes.data());
  }
  void operator()(Raster<uint16_t>& to) const {
    const auto shades = strip.row(output, j, k);
    to.values.insert(to.values.end(), shades.begin(), shades.end());
  }
  void operator()(Raster<Colour>& to) const {
    const size_t begin = to.values.size();
    to.values.resize(begin + to.width);
    for (size_t part = 0; part < Colour().size(); ++part) {
      const auto numbers = strip.row(output + part, j, k);
      for (size_t i = 0; i < numbers.size(); ++i) to.values[begin + i][part] = static_cast<uint8_t>(numbers[i]);
    }
  }
};

class ValueLayers {
 public:
  // The program's outputs are the numbers of the channels, then `checks` that are 1 where one fails.
  ValueLayers(program::Program program, const voxel::Lattice& lattice, voxel::Evaluator evaluator,
              std::vector<Channel> channels, size_t checks)
      : fields_(std::move(program), lattice, evaluator), channels_(std::move(channels)), checks_(checks) {
    for (const Channel& channel : channels_) numbers_ += numbers_of(channel);
  }

  std::vector<LayerResult> region(const TileBox& region, const StopFlag* stop) const {
    std::vector<LayerResult> layers(static_cast<size_t>(region.size(2)));
    for (LayerResult& layer : layers) {
      layer.checks.resize(checks_);
      for (const Channel& channel : channels_)
        layer.channels.push_back(voxel::blank_pixels(channel.type, static_cast<uint32_t>(region.size(0)), 0));
    }
    for (int64_t j = region.lo[1]; j < region.hi[1]; j += strip_rows) {
      if (stop && stop->requested()) throw Cancelled();
      TileBox box = region;
      box.lo[1] = j;
      box.hi[1] = std::min(j + strip_rows, region.hi[1]);
      append_strip(box, layers, stop);
    }
    return layers;
  }

 private:
  void append_strip(const TileBox& box, std::vector<LayerResult>& layers, const StopFlag* stop) const {
    Strip strip(box, numbers_ + checks_);
    for (const FieldTile& tile : fields_.tiles(box, stop)) strip.take(tile);
    for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        LayerResult& layer = layers[static_cast<size_t>(k - box.lo[2])];
        append_row(strip, j, k, layer);
        for (size_t check = 0; check < checks_; ++check)
          count(strip.row(numbers_ + check, j, k), {box.lo[0], j, k}, layer.checks[check]);
      }
  }

  // Counts the voxels of a row, which begins at this voxel, whose check fails.
  static void count(std::span<const uint16_t> fails, const std::array<int64_t, 3>& begin, voxel::CheckHits& hits) {
    const auto first = std::ranges::find(fails, uint16_t{1});
    if (first == fails.end()) return;
    if (hits.count == 0) hits.first = {begin[0] + (first - fails.begin()), begin[1], begin[2]};
    hits.count += static_cast<uint64_t>(std::count(first, fails.end(), uint16_t{1}));
  }

  void append_row(Strip& strip, int64_t j, int64_t k, LayerResult& layer) const {
    size_t output = 0;
    for (size_t n = 0; n < channels_.size(); ++n) {
      std::visit(RowAppender{strip, output, j, k}, layer.channels[n]);
      output += numbers_of(channels_[n]);
    }
  }

  voxel::FieldEvaluator fields_;
  std::vector<Channel> channels_;
  size_t numbers_ = 0, checks_ = 0;
};

std::optional<Channel> colour_channel(const design::Design& design, const ValueChoice& choice,
                                      Diagnostics& diagnostics) {
  if (!choice.range && choice.bits == 8) return Channel{choice.of, ChannelType::colour, "", {0, 1}};
  diagnostics.error(Code::option, design.parts[0].solid->where(),
                    '"' + choice.of + "\" is a colour, whose numbers are 0 to 1 in 8 bits each",
                    "leave " + spelled::option("--bits") + " and " + spelled::option("--range") + " out");
  return std::nullopt;
}

}  // namespace

std::optional<Channel> value_channel(const design::Design& design, const Box& box, const ValueChoice& choice,
                                     Diagnostics& diagnostics) {
  if (choice.samples > 0) return coverage_channel(choice.samples);
  if (is_colour(design, choice.of)) return colour_channel(design, choice, diagnostics);
  const ChannelType type = voxel::number_type(choice.bits);
  Channel channel{choice.of, type, value_unit(design, choice.of), choice.range.value_or(Interval(0, 1))};
  const size_t errors = diagnostics.error_count();
  const bool has_usual_range = design.materials.find(choice.of) || type == ChannelType::mask;
  if (!choice.range && !has_usual_range)
    if (const auto found = value_range(design, box, choice.of, diagnostics)) channel.range = *found;
  if (diagnostics.error_count() > errors) return std::nullopt;
  return channel;
}

std::optional<RegionProducer> value_layers(const design::Design& design, const voxel::Lattice& lattice,
                                           const std::vector<Channel>& channels, voxel::Evaluator evaluator,
                                           Diagnostics& diagnostics, RangeChecks checks) {
  if (is_coverage(channels.front())) return coverage_layers(design, lattice, channels.front(), evaluator, diagnostics);
  Question question(design);
  program::Outputs outputs;
  for (const Channel& channel : channels)
    if (!add_outputs(channel, question, outputs, diagnostics)) return std::nullopt;
  const size_t numbers = outputs.size();
  for (const Channel& channel : channels)
    if (checks == RangeChecks::both_ends && !add_beyond(channel, question, outputs, diagnostics)) return std::nullopt;
  auto program = question.program(outputs, diagnostics);
  if (!program) return std::nullopt;
  const auto layers =
      std::make_shared<const ValueLayers>(std::move(*program), lattice, evaluator, channels, outputs.size() - numbers);
  return [layers](const TileBox& region, const StopFlag* stop) { return layers->region(region, stop); };
}

std::vector<std::string> texts_of_range_checks(const Channel& channel) {
  const auto text = [&](const char* side, const char* verb, double end) {
    return channel.name + " is " + side + " the range of the images, which " + verb + " at " + format_rounded(end, 6) +
           (channel.unit.empty() ? "" : " " + channel.unit);
  };
  return {text("below", "begins", channel.range.lo), text("above", "ends", channel.range.hi)};
}

size_t value_working_bytes(const std::vector<Channel>& channels, const voxel::Lattice& lattice, int64_t layers) {
  if (is_coverage(channels.front())) return coverage_working_bytes(channels.front(), lattice, layers);
  size_t bytes = 0;  // of a voxel of a strip: its numbers as they are evaluated, and as they are rounded
  for (const Channel& channel : channels)
    if (channel.type != ChannelType::material) bytes += numbers_of(channel) * (sizeof(float) + sizeof(uint16_t));
  return bytes * static_cast<size_t>(lattice.count[0] * std::min(strip_rows, lattice.count[1]) * layers);
}

}  // namespace ombre::compile
