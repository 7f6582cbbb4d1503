// Answers about scans: planes of their numbers, and single numbers.
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

// The numbers of a scan, in the file's own units.
struct Scan {
  formats::VoxelVolume volume;
  Interval range;  // range of all values
  Interval shown;  // without the lowest and the highest half a percent
  double otsu = 0;
};
using ScanPtr = std::shared_ptr<const Scan>;

// Reads a scan. `path` is a file or a folder of DICOM files, and `stop` may be null. Throws Error and Cancelled.
Scan read_scan(const std::string& path, const formats::VolumeChoice& choice, const StopFlag* stop);

// Keeps the scans that were used last. Thread-safe.
class Scans {
 public:
  static constexpr size_t most = 2;

  explicit Scans(const Workspace& workspace) : workspace_(workspace) {}

  // Each function answers one kind of request (docs/reference/studio-api.md). They throw RequestError, Error and
  // Cancelled.

  // "scan": the size of a scan, its place and the range of its values.
  Answer describe(const Request& request, const StopFlag& stop);
  // "plane": numbers of a plane as floats, low byte first, the row of the least number first.
  Answer plane(const Request& request, const StopFlag& stop);
  // "voxel": the number of a voxel, and the place of its centre.
  Answer voxel(const Request& request, const StopFlag& stop);

 private:
  ScanPtr find(const Request& request, const StopFlag& stop);

  const Workspace& workspace_;
  std::mutex mutex_;
  std::list<std::pair<std::string, ScanPtr>> kept_;  // by path, choice and stamp; the most recently used first
};

}  // namespace ombre::studio
