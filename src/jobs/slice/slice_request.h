// The requests of slice jobs, and their reports.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/progress.h"
#include "formats/images/png.h"
#include "jobs/common/cost_profile.h"
#include "jobs/common/layer_range.h"
#include "jobs/common/sampling_rules.h"
#include "jobs/slice/layer_entry.h"
#include "stages/job_stages.h"
#include "stores/folder_use.h"
#include "stores/shard.h"
#include "voxel/channel.h"
#include "voxel/lattice.h"
#include "voxel/layers.h"
#include "voxel/printer.h"

namespace ombre::compile {

struct SliceMaterial {
  std::string name;
  MaterialId id = 1;
  formats::Rgba rgba{};
};

// The place of a box of voxels in a larger job.
struct PartOfJob {
  std::array<int64_t, 3> first{}, count{};  // the least voxel, and the voxels of the whole
};

// Everything that decides the voxels of a job, already resolved.
struct Sampling : SamplingRules {
  std::string program;      // "ombre 0.1.0"
  std::string design_hash;  // hex
  voxel::Lattice lattice;
  std::optional<PartOfJob> part;  // set if the lattice is a part of another
  std::vector<voxel::Channel> channels = {
      voxel::Channel{}};                  // channels of the layers; the first one is of materials if any is
  std::vector<SliceMaterial> materials;   // materials in use, by ascending id, without void
  std::vector<std::string> check_texts;   // one for each check of the program: a text for people about the failure
  DataList resolved;                      // how properties were resolved, a step each, for job.json
  DataList corrections;                   // changes of the voxels that a design gives, a step each, for job.json
  std::vector<std::string> check_places;  // places of the checks in the design, "part.vcad:3:1"; they decide no bytes

  bool has_materials() const;
};

// Everything that decides the bytes of a job.
struct SliceRequest : Sampling, voxel::Images {
  std::string printer;  // name of the profile
};

// Applies the conventions of a profile; `image` overrides its image format. If the channels have images of another
// format only, it is the first of those. Masks always have one file for each material.
void use_printer(SliceRequest& request, const voxel::Printer& printer, std::optional<ImageFormat> image);

// A function that makes a box of the job's voxels, layer by layer, lowest first; results have its width and height. It
// is called from several threads, and throws Cancelled when asked to stop.
using RegionProducer =
    std::function<std::vector<voxel::LayerResult>(const voxel::TileBox& region, const StopFlag* stop)>;

// A function that makes layers [begin, end), lowest first. It is called from several threads, and throws Cancelled when
// asked to stop.
using LayerProducer = std::function<std::vector<voxel::LayerResult>(int64_t begin, int64_t end, const StopFlag* stop)>;

// Returns a producer of layers of the whole width and height of the lattice.
LayerProducer whole_layers(RegionProducer regions, const voxel::Lattice& lattice);

using stores::FolderUse;

// Options that do not decide any bytes.
struct SliceOptions {
  std::string folder;
  FolderUse use = FolderUse::fresh;
  std::optional<LayerRange> layers;       // a part of the job, with the names and bytes it has in the whole
  std::optional<stores::Shard> shard;     // the layers are a share of a job that other processes work on, too
  int threads = 0;                        // 0: all cores
  size_t memory_bytes = size_t{2} << 30;  // for layers in flight; one at a time is always allowed
  bool strict = false;                    // stops at the first slab in which a check fails
  JobStagesPtr stages = nullptr;          // to be prepared before layers are made; null: there are none
  bool only_stages = false;               // keeps the stages, and makes no layers
};

struct CheckReport {
  std::string text;
  uint64_t voxels = 0;
  Vec3 first_mm;  // centre of the lowest voxel concerned, in the design's space
};

struct SliceReport {
  LayerRange layers;
  int64_t layers_written = 0;  // in this run
  int64_t layers_kept = 0;     // finished by an earlier run
  int64_t layers_dropped = 0;  // empty ones that the printer does not want
  uint64_t voxels_inside = 0;  // in `layers`, as are the counts below
  VoxelCounts counts;
  std::vector<CheckReport> checks;  // checks that failed somewhere
  uint64_t bytes_written = 0;
  double seconds = 0;
  bool whole_job_finished = false;
  bool stopped_by_check = false;
};

struct SliceEstimate {
  double seconds = 0;
  uint64_t bytes = 0;               // size of image files
  bool is_least = false;            // nothing was done in time: it takes this long at least, and bytes are unknown
  size_t memory_bytes = 0;          // the most that layers in flight can take
  std::vector<CheckReport> checks;  // checks that failed in the sampled layers
  CostProfile costs;                // of layers on one thread
};

}  // namespace ombre::compile
