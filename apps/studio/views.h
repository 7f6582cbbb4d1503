// Views of a design for the page: pictures, tiles of layers, points, volumes.
#pragma once

#include "base/system/progress.h"
#include "jobs/picture/cut_faces.h"
#include "studio/designs.h"
#include "studio/workspace/studio_messages.h"

namespace ombre::studio {

// Each function answers one kind of request (docs/reference/studio-api.md). They throw RequestError, Error and
// Cancelled.

// Answers "render": a picture from a camera, with cuts, as PNG.
Answer picture_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// Answers "seen_at": the point of the surface that such a picture shows at a pixel.
Answer seen_at_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// Answers "thumbnail": a small picture of the result of one node of the design, as PNG.
Answer thumbnail_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// Answers "plan": the lattice of a printer's job, its materials, and the text of job.json.
Answer plan_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// Answers "tile": some pixels of a layer, as PNG.
Answer tile_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// Answers "probe": properties of the design at a point, and the voxel there.
Answer probe_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// Answers "volume": fractions of materials on a coarse grid, for graphics processors.
Answer volume_answer(OpenDesign& design, const Request& request, const StopFlag& stop);
// Answers "measure": volume and mass of each material.
Answer measure_answer(OpenDesign& design, const Request& request, const StopFlag& stop);

// Answers "estimate": an estimate of what a job would take, from a few of its layers.
Answer estimate_answer(OpenDesign& design, const Request& request, const StopFlag& stop);

// Answers "compare": the volumes in mm3 that `after` has gained, lost and changed in material against `before`.
Answer compare_answer(const OpenDesign& before, const OpenDesign& after, const StopFlag& stop);

// Returns the colours of the materials of a job's voxels at places on faces: of the voxel behind the face. Void has
// none. Tiles of voxels are kept in the memory, which must outlive the function, as must `stop`.
compile::FaceColours voxels_on_faces(CutDesignPtr cut, design::SubDesignMemory& memory, const StopFlag& stop);

}  // namespace ombre::studio
