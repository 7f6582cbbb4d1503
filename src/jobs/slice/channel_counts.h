// Counts the voxels of layers by channels, and says what was counted.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/text/data.h"
#include "jobs/slice/layer_entry.h"
#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// Returns the numbers that the counts and checks of each of the job's layers have.
LayerSizes layer_sizes(const SliceRequest& request);

VoxelCounts count_voxels(const SliceRequest& request, const voxel::LayerResult& layer);

// Returns the counts of no layer, to which those of layers are added.
VoxelCounts no_counts(const SliceRequest& request);

// Returns "materials", a list with each material, if the job has any; and "channels", a list with each other channel,
// if there is one. Volumes are left out if the volume of a voxel is not given.
DataMembers describe_counts(const SliceRequest& request, const VoxelCounts& counts, std::optional<double> voxel_mm3);

// Returns a text for each material and each other channel, such as "dose: 52,704 voxels above 0, mean 5.3 J".
std::vector<std::string> count_texts(const SliceRequest& request, const VoxelCounts& counts,
                                     std::optional<double> voxel_mm3);

// Describes the channels other than materials: their names, types, and what their shades mean.
DataList describe_channels(const SliceRequest& request);

double voxel_mm3(const voxel::Lattice& lattice);

}  // namespace ombre::compile
