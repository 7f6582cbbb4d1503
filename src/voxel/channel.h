// Channels of layers: what their voxels hold, in which type, and what is counted of them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/math/interval.h"
#include "base/math/run.h"

namespace ombre::voxel {

enum class ChannelType { material, dose8, dose16, mask, colour };

// The properties that all channels of a type share.
struct ChannelKind {
  std::string name;     // in job.json
  std::string plural;   // what the voxels hold, for messages
  int bits = 8;         // of a voxel
  int last_shade = 0;   // the shade of the upper end of a range of numbers; 0 if voxels hold no numbers
  std::string counted;  // which voxels are counted, for reports: "voxels above 0"

  // True if the mean of the shades says more than how many voxels are counted.
  bool is_dose() const { return last_shade > 1; }
};

const ChannelKind& channel_kind(ChannelType type);
std::optional<ChannelType> channel_type(std::string_view name);
// Returns the type whose voxels hold numbers of this many bits, one of those in number_bits().
ChannelType number_type(int bits);
const std::vector<std::string>& number_bits();

struct Channel {
  std::string name = "materials";  // or the name of what it shows
  ChannelType type = ChannelType::material;
  std::string unit;         // of numbers
  Interval range = {0, 1};  // numbers up to range.lo have the shade 0, from range.hi on the last one
  int samples = 0;          // points along x and y of a voxel whose share inside the shade shows; 0: a value's shade
  bool operator==(const Channel&) const = default;
};

// Returns the number that a shade stands for.
double value_of_shade(const Channel& channel, double shade);

using Colour = std::array<uint8_t, 4>;  // red, green, blue in sRGB, and alpha; not premultiplied

// Voxels row by row. Row 0 has the least y.
template <class T>
struct Raster {
  uint32_t width = 0;
  std::vector<T> values;
  uint32_t height() const { return static_cast<uint32_t>(values.size() / width); }
};

// The voxels of a channel in one layer: runs of materials, of shades of 8 bits, or of 0 and 1 in masks; shades of 16
// bits; or colours.
using ChannelPixels = std::variant<RunLayer, Raster<uint16_t>, Raster<Colour>>;

// Returns pixels that are all 0.
ChannelPixels blank_pixels(ChannelType type, uint32_t width, uint32_t height);

// How many pixels of a channel other than materials hold something, and how much.
struct PixelCount {
  uint64_t voxels = 0;  // those that are not 0, or of a colour that is not fully transparent
  uint64_t shades = 0;  // the sum of their shades
};
PixelCount count_pixels(const ChannelPixels& pixels);

}  // namespace ombre::voxel
