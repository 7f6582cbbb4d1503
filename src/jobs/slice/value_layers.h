// Makes layers of a value in shades of gray, for machines that dose light or infill by an image.
#pragma once

#include <optional>
#include <string>

#include "design/design.h"
#include "jobs/common/plan_options.h"
#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// Returns nothing, and adds a diagnostic, when the design has no such value.
std::optional<ShadeMeaning> shade_meaning(const design::Design& design, const Box& box, const ValueChoice& choice,
                                          Diagnostics& diagnostics);

// Makes voxels with the shades 0 to 255, or 65,535, instead of materials. The shade is 0 up to range.lo and outside,
// the last one from range.hi on, and linear and rounded to the nearest in between. Shades of 16 bits are counted by
// their upper bytes, 1 to 255 as 1. Returns nothing, and adds a diagnostic, if the program would not fit into memory.
std::optional<RegionProducer> value_layers(const design::Design& design, const voxel::Lattice& lattice,
                                           const ShadeMeaning& meaning, voxel::Evaluator evaluator,
                                           Diagnostics& diagnostics);

// Returns all shades except black, as a job's materials.
std::vector<SliceMaterial> value_shades();

}  // namespace ombre::compile
