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

struct LayerEntry {
  int64_t layer = 0;                      // counted from the lowest layer of the job
  std::vector<stores::StoredFile> files;  // empty if an empty layer was dropped
  std::vector<uint64_t> voxels;           // of each of the job's materials
  std::vector<voxel::CheckHits> checks;   // of each of the job's checks

  bool is_empty() const;
};

// Returns the members of the layer's line beside its number and its files.
DataMembers record_of(const LayerEntry& layer);

// Returns nothing for an entry that is not of this job.
std::optional<LayerEntry> layer_of(const stores::Entry& entry, size_t material_count, size_t check_count);

// Returns the layers of a journal, sorted.
std::vector<LayerEntry> parse_layers(std::string_view journal, size_t material_count, size_t check_count);

}  // namespace ombre::compile
