// The formats of grids of numbers that this folder reads: one table, whose rows are compared with a file's content.
#pragma once

#include <span>

#include "base/system/file_format.h"
#include "formats/volumes/volume.h"

namespace ombre::formats {

struct VolumeFormat {
  FileFormat file;
  // True if the content shows that a file has this format; null where nothing in it tells.
  bool (*recognises)(std::string_view bytes) = nullptr;
  VoxelVolume (*read)(const VolumeFile& file) = nullptr;
  // The path of the file that holds the rest, as companion_of() returns it; null for formats of one file.
  std::string (*companion)(const std::string& path, std::string_view bytes) = nullptr;
  std::vector<VolumeSegment> (*segments)(const std::string& path, std::string_view bytes) = nullptr;
};

// Raw numbers come last: a file that no other row recognises may be that.
std::span<const VolumeFormat> volume_formats();
// Returns the row that recognises the content, or that of raw numbers.
const VolumeFormat& format_of_volume(std::string_view bytes);

}  // namespace ombre::formats
