#include "voxel/image_kinds.h"

#include <algorithm>

#include "base/system/assert.h"

namespace ombre::voxel {
namespace {

// The kinds in the order of ImageFormat.
const std::vector<ImageKind>& image_kinds() {
  using enum ChannelType;
  static const std::vector<ImageKind> rows{
      {"rgba",
       "8 bits a channel; the exact colours of the materials, void fully transparent unless the profile has another "
       "background",
       {material, colour},
       // Each pixel has four bytes, which are coded one by one if no match is found.
       [](double information) { return std::min(32.0, 4 * information); }},
      {"indexed",
       "a palette, at the fewest bits that hold the layer's materials",
       {material},
       [](double information) { return std::min(8.0, information + 0.5); }},
      {"gray",
       "the brightness of the materials' colours, 0.299 r + 0.587 g + 0.114 b, or a value",
       {material, dose8, dose16},
       [](double information) { return std::min(8.0, information + 0.5); }},
      {"mask",
       "black and white: a file for each material, white where it is",
       {material, mask},
       [](double) { return 1.0; }},
  };
  return rows;
}

}  // namespace

const ImageKind& image_kind(ImageFormat format) { return image_kinds()[static_cast<size_t>(format)]; }

bool takes(ImageFormat format, ChannelType type) {
  const auto& types = image_kind(format).takes;
  return std::ranges::find(types, type) != types.end();
}

std::vector<std::string> image_formats_of(ChannelType type) {
  std::vector<std::string> names;
  for (const std::string& name : image_format_names())
    if (takes(*image_format(name), type)) names.push_back(name);
  return names;
}

ImageFormat format_for(ChannelType type, ImageFormat format) {
  if (takes(format, type)) return format;
  const std::vector<std::string> names = image_formats_of(type);
  ASSERT(!names.empty());
  return *image_format(names.front());
}

const std::vector<std::string>& image_format_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    for (const ImageKind& row : image_kinds()) found.push_back(row.name);
    return found;
  }();
  return names;
}

std::optional<ImageFormat> image_format(std::string_view name) {
  const auto& names = image_format_names();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<ImageFormat>(found - names.begin());
}

const std::string& to_text(ImageFormat format) { return image_kind(format).name; }

}  // namespace ombre::voxel
