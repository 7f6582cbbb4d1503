// Writes grids of a job as dense files: raw, .npy and .nrrd.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "export/volume_file.h"
#include "jobs/grid/grid_job.h"
#include "jobs/grid/grid_report.h"

namespace ombre::compile {

// Returns a path for each grid: `path` itself for a single grid of materials, distances or an attribute, else
// part_red.npy, part_distance.npy and so on.
std::vector<std::string> volume_paths(const std::string& path, const std::vector<Grid>& grids);

// Returns the bytes of all files, without headers and before compression.
uint64_t volume_bytes(const GridJob& job);
// Returns the bytes that so many layers take in the file of each grid.
std::vector<uint64_t> numbers_bytes(const GridJob& job, int64_t layers);

// The numbers of a slab of layers, as the file of each grid has them.
struct SlabOfNumbers {
  voxel::TileBox box;
  std::vector<std::string> bytes;
  bool has_inside = false;
};
// Calls `take` with each slab, lowest first. Throws Cancelled.
using TakeNumbers = std::function<void(const SlabOfNumbers&)>;
void each_numbers(const GridJob& job, int threads, const TakeNumbers& take, Progress* progress, const StopFlag* stop);

// A format of dense files.
struct DenseFormat {
  const exporting::VolumeFormat* format = nullptr;
  bool is_gzip = false;
};

// The files of a job's grids, which get their names when all are complete. Throws Error.
class VolumeFiles {
 public:
  VolumeFiles(const GridJob& job, const std::vector<std::string>& paths, const DenseFormat& format);
  void append(size_t grid, std::string_view numbers) { files_[grid]->append(numbers); }
  // Returns the bytes that were written.
  uint64_t commit();

 private:
  std::vector<std::unique_ptr<exporting::VolumeFile>> files_;
};

// Writes the files, and keeps a few layers in memory. Files get their names when all are complete. Throws Error and
// Cancelled, and leaves nothing then.
GridReport write_volumes(const GridJob& job, const std::vector<std::string>& paths, const DenseFormat& format,
                         int threads, Progress* progress = nullptr, const StopFlag* stop = nullptr);

// A grid of the job, and its numbers as a file has them.
struct VolumeInMemory {
  exporting::Volume volume;
  std::string numbers;
};
// Returns all grids, in their order. Throws Cancelled.
std::vector<VolumeInMemory> volumes_in_memory(const GridJob& job, int threads, Progress* progress = nullptr,
                                              const StopFlag* stop = nullptr);

}  // namespace ombre::compile
