// Makes layers whose voxels hold the share of their area that is inside: edges of masks without stairs.
#pragma once

#include <optional>

#include "design/design.h"
#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// Returns the channel of layers with samples x samples points in each voxel, half-way up the layer.
voxel::Channel coverage_channel(int samples);
inline bool is_coverage(const voxel::Channel& channel) { return channel.samples > 0; }

// Makes layers of that channel: the shade is 255 times the share of the points that lie inside, rounded to the nearest.
// Returns nothing, and adds a diagnostic, if the program would not fit into memory.
std::optional<RegionProducer> coverage_layers(const design::Design& design, const voxel::Lattice& lattice,
                                              const voxel::Channel& channel, voxel::Evaluator evaluator,
                                              Diagnostics& diagnostics);

// Returns the most memory that making this many layers takes, without the layers.
size_t coverage_working_bytes(const voxel::Channel& channel, const voxel::Lattice& lattice, int64_t layers);

}  // namespace ombre::compile
