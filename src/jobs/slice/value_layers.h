// Makes layers whose channels show values: doses for machines that dose light or infill by an image, masks, colours.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "design/design.h"
#include "jobs/common/plan_options.h"
#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// Returns the channel that shows a value: of colours for an attribute that is a colour, else of numbers. Returns
// nothing, and adds a diagnostic, when the design has no such value, or when it has no such bits or range.
std::optional<voxel::Channel> value_channel(const design::Design& design, const Box& box, const ValueChoice& choice,
                                            Diagnostics& diagnostics);

// Whether layers have checks that fail where numbers lie below the range of their channel, and above it.
enum class RangeChecks : uint8_t { none, both_ends };

// Returns what failures of these checks of a channel mean, for people.
std::vector<std::string> texts_of_range_checks(const voxel::Channel& channel);

// Makes layers of channels other than materials. A number's shade is 0 up to range.lo and outside, the last one from
// range.hi on, and linear and rounded to the nearest in between. Colours are fully transparent outside. What is no
// number is 0. Returns nothing, and adds a diagnostic, if the program would not fit into memory.
std::optional<RegionProducer> value_layers(const design::Design& design, const voxel::Lattice& lattice,
                                           const std::vector<voxel::Channel>& channels, voxel::Evaluator evaluator,
                                           Diagnostics& diagnostics, RangeChecks checks = RangeChecks::none);

// Returns the most memory that making this many layers of these channels takes, without the layers.
size_t value_working_bytes(const std::vector<voxel::Channel>& channels, const voxel::Lattice& lattice, int64_t layers);

}  // namespace ombre::compile
