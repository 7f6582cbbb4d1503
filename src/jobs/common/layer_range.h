// Ranges of a job's layers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "stores/shard.h"

namespace ombre::compile {

// Layers [begin, end) of the whole job.
struct LayerRange {
  int64_t begin = 0, end = 0;
  bool operator==(const LayerRange&) const = default;
};

inline std::string to_text(LayerRange range) { return std::to_string(range.begin) + ":" + std::to_string(range.end); }

// Parses "a:b", "a:", ":b" or "a", like Python's slices; negative numbers count from the top. Returns nothing if the
// text is none of these or selects no layer.
std::optional<LayerRange> parse_layer_range(std::string_view text, int64_t layer_count);

// Returns the layers of a share of a range; shares have about the same number of layers, and some may have none.
LayerRange share_of(LayerRange range, const stores::Shard& shard);

}  // namespace ombre::compile
