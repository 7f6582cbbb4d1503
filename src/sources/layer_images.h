// Images of stacks: PNG, TIFF (of one or more pages) and BMP.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/file_format.h"
#include "base/system/progress.h"
#include "formats/volumes/volume.h"

namespace ombre::sources {

std::vector<FileFormat> image_file_formats();
// Returns true if the name ends like that of a supported image.
bool has_image_name(const std::string& path);
bool is_image(std::string_view bytes);

struct LayerNumbers {
  uint32_t width = 0, height = 0;
  std::string type;             // "uint16"
  int64_t channels = 1;         // values per pixel in the file
  formats::VoxelValues values;  // rows from the top
};

struct LayerColours {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;  // rows from the top
};

struct LayerStack {
  std::vector<LayerNumbers> layers;
  std::optional<Vec3> spacing_mm;  // if the file gives it
  std::vector<std::string> warnings;
};

// Returns the numbers of the pixels of each slice as stored: of 8 or 16 bits in PNG, of any type in TIFF. Where pixels
// have several values, or pages show several channels or frames, `choice` selects one; without it they are an error.
// Throws Error and Cancelled.
LayerStack read_layer_numbers(const std::string& path, std::string_view bytes, const formats::VolumeChoice& choice,
                              const StopFlag* stop);

// Returns the colours of the pixels of each page. Throws Error and Cancelled.
std::vector<LayerColours> read_layer_colours(const std::string& path, std::string_view bytes, const StopFlag* stop);

}  // namespace ombre::sources
