#include "voxel/channel.h"

#include <algorithm>

#include "base/system/assert.h"

namespace ombre::voxel {
namespace {

// The kinds in the order of ChannelType.
const std::vector<ChannelKind>& channel_kinds() {
  static const std::vector<ChannelKind> rows{
      {"material", "materials", 8, 0, "voxels"},
      {"dose8", "doses of 8 bits", 8, 255, "voxels above 0"},
      {"dose16", "doses of 16 bits", 16, 65535, "voxels above 0"},
      {"mask", "masks", 1, 1, "voxels"},
      {"colour", "colours", 32, 0, "voxels"},
  };
  return rows;
}

struct PixelCounter {
  PixelCount operator()(const RunLayer& layer) const {
    const std::array<uint64_t, 256> counts = count_materials(layer);
    PixelCount count;
    for (size_t byte = 1; byte < counts.size(); ++byte) {
      count.voxels += counts[byte];
      count.shades += byte * counts[byte];
    }
    return count;
  }

  PixelCount operator()(const Raster<uint16_t>& raster) const {
    PixelCount count;
    for (const uint16_t shade : raster.values) {
      count.voxels += shade > 0 ? 1 : 0;
      count.shades += shade;
    }
    return count;
  }

  PixelCount operator()(const Raster<Colour>& raster) const {
    const auto seen = std::ranges::count_if(raster.values, [](const Colour& colour) { return colour[3] > 0; });
    return {static_cast<uint64_t>(seen), 0};
  }
};

}  // namespace

const ChannelKind& channel_kind(ChannelType type) { return channel_kinds()[static_cast<size_t>(type)]; }

std::optional<ChannelType> channel_type(std::string_view name) {
  const auto& rows = channel_kinds();
  const auto found = std::ranges::find(rows, name, &ChannelKind::name);
  if (found == rows.end()) return std::nullopt;
  return static_cast<ChannelType>(found - rows.begin());
}

ChannelType number_type(int bits) {
  const auto& rows = channel_kinds();
  const auto found =
      std::ranges::find_if(rows, [&](const ChannelKind& row) { return row.last_shade > 0 && row.bits == bits; });
  ASSERT(found != rows.end() && "one of number_bits()");
  return static_cast<ChannelType>(found - rows.begin());
}

const std::vector<std::string>& number_bits() {
  static const std::vector<std::string> texts = [] {
    std::vector<std::string> found;
    for (const ChannelKind& row : channel_kinds())
      if (row.last_shade > 0) found.push_back(std::to_string(row.bits));
    return found;
  }();
  return texts;
}

double value_of_shade(const Channel& channel, double shade) {
  return channel.range.lo + (channel.range.hi - channel.range.lo) * shade / channel_kind(channel.type).last_shade;
}

ChannelPixels blank_pixels(ChannelType type, uint32_t width, uint32_t height) {
  const size_t count = size_t{width} * height;
  if (type == ChannelType::dose16) return Raster<uint16_t>{width, std::vector<uint16_t>(count)};
  if (type == ChannelType::colour) return Raster<Colour>{width, std::vector<Colour>(count)};
  RunLayer layer(width);
  for (uint32_t j = 0; j < height; ++j) layer.append_uniform_row(0);
  return layer;
}

PixelCount count_pixels(const ChannelPixels& pixels) { return std::visit(PixelCounter(), pixels); }

}  // namespace ombre::voxel
