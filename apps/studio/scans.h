// Scans as shown by the page: planes of numbers, and single numbers.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "base/math/interval.h"
#include "base/system/progress.h"
#include "formats/volumes/volume.h"
#include "studio/workspace/studio_messages.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// A scan with its numbers in the file's own units.
struct Scan {
  formats::VoxelVolume volume;
  Interval range;  // range of its values
  Interval shown;  // range without the lowest and the highest 0.5 %
  double otsu = 0;
};
using ScanPtr = std::shared_ptr<const Scan>;

// Reads a scan; `path` is a file or a folder of DICOM files. `stop` may be null. Throws Error and Cancelled.
Scan read_scan(const std::string& path, const formats::VolumeChoice& choice, const StopFlag* stop);

// Keeps the most recently viewed scans. Thread-safe.
class Scans {
 public:
  static constexpr size_t most = 2;

  explicit Scans(const Workspace& workspace) : workspace_(workspace) {}

  // Each function answers one kind of request (docs/reference/studio-api.md). They throw RequestError, Error and
  // Cancelled.

  // Answers "scan": its size, its position and the range of its values.
  Answer describe(const Request& request, const StopFlag& stop);
  // Answers "plane": the numbers of a plane as little-endian floats, lowest row first.
  Answer plane(const Request& request, const StopFlag& stop);
  // Answers "voxel": the number of a voxel, and the position of its centre.
  Answer voxel(const Request& request, const StopFlag& stop);

 private:
  ScanPtr find(const Request& request, const StopFlag& stop);

  const Workspace& workspace_;
  std::mutex mutex_;
  std::list<std::pair<std::string, ScanPtr>> kept_;  // most recently used first, by path and choice
};

}  // namespace ombre::studio
