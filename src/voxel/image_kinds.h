// The table of the kinds of images of layers: what they are called, and which channels they take.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/image_layout.h"
#include "voxel/channel.h"

namespace ombre::voxel {

struct ImageKind {
  std::string name;                // in profiles and on command lines
  std::string pixels;              // what they are, for the reference
  std::vector<ChannelType> takes;  // types of channels that it shows
  // Returns the most bits that a pixel takes in a file if materials are noise of `information` bits a voxel.
  double (*noise_bits)(double information) = nullptr;
};

const ImageKind& image_kind(ImageFormat format);
bool takes(ImageFormat format, ChannelType type);
// Returns the names of the formats that take the type.
std::vector<std::string> image_formats_of(ChannelType type);
// Returns the format if it takes the type, else the first one that does.
ImageFormat format_for(ChannelType type, ImageFormat format);

// Returns the names in profiles and on command lines, in the order of ImageFormat.
const std::vector<std::string>& image_format_names();
std::optional<ImageFormat> image_format(std::string_view name);
const std::string& to_text(ImageFormat format);

}  // namespace ombre::voxel
