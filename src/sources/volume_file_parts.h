// Volumes in files and folders, whichever library reads them.
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

// The contents of a file, as long as their keeper lives. Throws Error.
using ReadFile = std::function<FileView(const std::string& path)>;

// The files that make a volume.
struct VolumeParts {
  enum class Kind : uint8_t { numbers, dicom, vdb, images };
  Kind kind = Kind::numbers;
  std::vector<std::string> files;  // the first is the volume itself, or all of a folder in the order of their numbers
  bool has_companion = false;      // the second file holds the rest of the first
  std::vector<formats::VolumeSegment> segments = {};  // that the volume names
};

// `path` is a file, or a folder of DICOM files or of images. Throws Error.
VolumeParts volume_parts(const std::string& path, const ReadFile& read);

// The name of a choice is the number or UID of one of several DICOM series, or the name of one of several grids. Throws
// Error, naming the path; Cancelled once `stop`, which may be null, is set. Adds what a designer should know to
// `warnings`.
formats::VoxelVolume read_volume_parts(const std::string& path, const VolumeParts& parts,
                                       const formats::VolumeChoice& choice, const ReadFile& read, const StopFlag* stop,
                                       std::vector<std::string>& warnings);

Interval value_range(const formats::VoxelVolume& volume);
// From the number that 0.5 % of the voxels are below to the one that 0.5 % are above: what black and white show.
Interval shown_range(const formats::VoxelVolume& volume);

// Above which Otsu's method finds the brighter class (N. Otsu, A threshold selection method from gray-level histograms,
// 1979), by 256 equal parts of the range: a level for volume_solid.
double otsu_level(const formats::VoxelVolume& volume);

}  // namespace ombre::sources
