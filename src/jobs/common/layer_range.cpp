#include "jobs/common/layer_range.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"

namespace ombre::compile {
namespace {

std::optional<int64_t> whole_number(std::string_view text) {
  const std::optional<double> number = parse_number(text);
  if (!number || *number != std::floor(*number) || std::abs(*number) > 1e15) return std::nullopt;
  return static_cast<int64_t>(*number);
}

// Applies Python's rule: negative numbers count from the end, and positions outside are clamped.
int64_t position(int64_t number, int64_t count) {
  return std::clamp<int64_t>(number < 0 ? number + count : number, 0, count);
}

}  // namespace

std::optional<LayerRange> parse_layer_range(std::string_view text, int64_t layer_count) {
  const size_t colon = text.find(':');
  const std::string_view first = trim(text.substr(0, colon));
  LayerRange range{0, layer_count};
  if (!first.empty() || colon == std::string_view::npos) {
    const std::optional<int64_t> begin = whole_number(first);
    if (!begin) return std::nullopt;
    if (colon == std::string_view::npos) {  // one layer, which must exist
      const int64_t layer = *begin < 0 ? *begin + layer_count : *begin;
      if (layer < 0 || layer >= layer_count) return std::nullopt;
      return LayerRange{layer, layer + 1};
    }
    range.begin = position(*begin, layer_count);
  }
  if (const std::string_view last = trim(text.substr(colon + 1)); !last.empty()) {
    const std::optional<int64_t> end = whole_number(last);
    if (!end) return std::nullopt;
    range.end = position(*end, layer_count);
  }
  if (range.begin >= range.end) return std::nullopt;
  return range;
}

LayerRange share_of(LayerRange range, const stores::Shard& shard) {
  const int64_t count = range.end - range.begin;
  const auto border = [&](int64_t n) {  // without the product of two large numbers
    return range.begin + count / shard.count * n + count % shard.count * n / shard.count;
  };
  return {border(shard.number - 1), border(shard.number)};
}

}  // namespace ombre::compile
