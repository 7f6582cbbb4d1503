// Layers of a value in shades of gray, as machines take them that dose light or infill by an image.
#pragma once

#include <optional>
#include <string>

#include "design/design.h"
#include "jobs/common/plan_options.h"
#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// Nothing, and a diagnostic, when the design has no such value.
std::optional<ShadeMeaning> shade_meaning(const design::Design& design, const Box& box, const ValueChoice& choice,
                                          Diagnostics& diagnostics);

// Voxels have the shades 0 to 255, or 65,535, in place of materials: 0 up to range.lo and outside, the last from
// range.hi on, linear and to the nearest in between. Those of 16 bits are counted by their upper bytes, 1 to 255 as 1.
// Nothing, and a diagnostic, when the program would not fit into memory.
std::optional<RegionProducer> value_layers(const design::Design& design, const voxel::Lattice& lattice,
                                           const ShadeMeaning& meaning, voxel::Evaluator evaluator,
                                           Diagnostics& diagnostics);

// The shades but for black, as a job's materials.
std::vector<SliceMaterial> value_shades();

}  // namespace ombre::compile
