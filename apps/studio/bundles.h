// Export and import of designs with their files: bundles, and the examples that come with Ombre.
#pragma once

#include "base/system/progress.h"
#include "studio/workspace/studio_messages.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// Each function answers one kind of request (docs/reference/studio-api.md). They throw RequestError, Error and
// Cancelled.

// Answers "bundle": a design as stored on disk, with the files that it reads.
Answer bundle_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);
// Answers "unbundle": unpacks a bundle into its own folder.
Answer unbundle_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);
// Answers "examples": their names, and the first sentence of each.
Answer examples_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);
// Answers "example_picture": a PNG; without bytes if the example has none.
Answer example_picture_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);
// Answers "open_example": copies an example into its own folder.
Answer open_example_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);

}  // namespace ombre::studio
