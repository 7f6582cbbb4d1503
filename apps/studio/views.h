// What the page shows of a design: pictures, tiles of layers, points, volumes.
#pragma once

#include "base/system/progress.h"
#include "studio/designs.h"
#include "studio/workspace/studio_messages.h"

namespace ombre::studio {

// Each answers one kind of request (docs/reference/studio-api.md). They throw RequestError, Error and Cancelled.

// "render": a picture from a camera, with cuts, as PNG.
Answer picture_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// "thumbnail": a small picture of what one node of the design makes, as PNG.
Answer thumbnail_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// "plan": the lattice of a printer's job, its materials, the text of job.json.
Answer plan_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// "tile": some pixels of a layer, as PNG.
Answer tile_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// "probe": what the design is at a point, and the voxel there.
Answer probe_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// "volume": fractions of materials on a coarse grid, for graphics processors.
Answer volume_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// "measure": volume and mass of each material.
Answer measure_answer(OpenDesign& design, const Request& request, const StopFlag& stop);

// "estimate": what a job would take, from a few of its layers.
Answer estimate_answer(OpenDesign& design, const Request& request, const StopFlag& stop);

// "compare": what `after` has more than `before`, less, and of other materials, in mm3.
Answer compare_answer(const OpenDesign& before, const OpenDesign& after, const StopFlag& stop);

}  // namespace ombre::studio
