// Reads volumes from files and folders with whichever library is needed.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/math/interval.h"
#include "base/system/progress.h"
#include "formats/volumes/volume.h"
#include "sources/file_store.h"

namespace ombre::sources {

// Returns the contents of a file, valid as long as their keeper lives. Throws Error.
using ReadFile = std::function<FileView(const std::string& path)>;

// The files of a volume.
struct VolumeParts {
  enum class Kind : uint8_t { numbers, dicom, vdb, images };
  Kind kind = Kind::numbers;
  std::vector<std::string> files;  // first the volume itself, or all files of a folder in the order of their numbers
  bool has_companion = false;      // the second file contains the rest of the first
  std::vector<formats::VolumeSegment> segments = {};  // segments that the volume names
};

// Returns the parts of a volume; `path` is a file, or a folder of DICOM files or of images. Throws Error.
VolumeParts volume_parts(const std::string& path, const ReadFile& read);

// Reads a volume. The name in `choice` is the number or UID of one of several DICOM series, or the name of one of
// several grids. Adds remarks for the designer to `warnings`. Throws Error, naming the path, and Cancelled once `stop`,
// which may be null, is set.
formats::VoxelVolume read_volume_parts(const std::string& path, const VolumeParts& parts,
                                       const formats::VolumeChoice& choice, const ReadFile& read, const StopFlag* stop,
                                       std::vector<std::string>& warnings);

Interval value_range(const formats::VoxelVolume& volume);
// Returns the range shown from black to white: 0.5 % of the voxels are below it, 0.5 % above.
Interval shown_range(const formats::VoxelVolume& volume);

// Returns the level above which Otsu's method finds the brighter class (N. Otsu, A threshold selection method from
// gray-level histograms, 1979), with 256 equal bins over the range; suitable as a level of volume_solid.
double otsu_level(const formats::VoxelVolume& volume);

}  // namespace ombre::sources
