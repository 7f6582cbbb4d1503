// Answers about views of a design: pictures, tiles of layers, points, volumes.
#pragma once

#include "base/system/progress.h"
#include "studio/designs.h"
#include "studio/workspace/studio_messages.h"

namespace ombre::studio {

// Each function answers one kind of request (docs/reference/studio-api.md). They throw RequestError, Error and
// Cancelled.

// "render": a picture from a camera, with cuts, as PNG.
Answer picture_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// "thumbnail": a small picture of the result of a node, as PNG.
Answer thumbnail_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// "plan": the lattice of a printer's job, its materials, the text of job.json.
Answer plan_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// "tile": some pixels of a layer, as PNG.
Answer tile_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// "probe": the design at a point, and the voxel there.
Answer probe_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// "volume": fractions of materials on a coarse grid, for graphics processors.
Answer volume_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// "measure": volume and mass of each material.
Answer measure_answer(OpenDesign& design, const Request& request, const StopFlag& stop);

// "estimate": time and memory of a job, from a few of its layers.
Answer estimate_answer(OpenDesign& design, const Request& request, const StopFlag& stop);

// "compare": the volumes in mm3 that `after` has gained, lost and changed against `before`.
Answer compare_answer(const OpenDesign& before, const OpenDesign& after, const StopFlag& stop);

}  // namespace ombre::studio
