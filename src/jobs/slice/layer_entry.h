// Converts layers of a slice job from and to the entries of its journal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stores/journal.h"
#include "voxel/layers.h"

namespace ombre::compile {

inline constexpr const char* layer_member = "layer";  // the number of the layer in its line

// The counts of a layer's voxels.
struct VoxelCounts {
  std::vector<uint64_t> voxels;  // of each of the job's materials, and of each other channel those that are not 0
  std::vector<uint64_t> shades;  // of each channel of doses the sum of its shades

  bool is_empty() const;
  void add(const VoxelCounts& other);
};

struct LayerEntry {
  int64_t layer = 0;                      // counted from the lowest layer of the job
  std::vector<stores::StoredFile> files;  // empty if an empty layer was dropped
  VoxelCounts counts;
  std::vector<voxel::CheckHits> checks;  // of each of the job's checks
};

// The sizes of the lists of a layer's entry.
struct LayerSizes {
  size_t voxels = 0, shades = 0, checks = 0;
};

// Returns the members of the layer's line beside its number and its files.
DataMembers record_of(const LayerEntry& layer);

// Returns nothing for an entry that is not of a job with these sizes.
std::optional<LayerEntry> layer_of(const stores::Entry& entry, const LayerSizes& sizes);

// Returns the layers of a journal, sorted.
std::vector<LayerEntry> parse_layers(std::string_view journal, const LayerSizes& sizes);

}  // namespace ombre::compile
