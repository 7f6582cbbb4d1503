// Answers about designs with their files: bundles, and the examples that come with Ombre.
#pragma once

#include "base/system/progress.h"
#include "studio/workspace/studio_messages.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// Each function answers one kind of request (docs/reference/studio-api.md). They throw RequestError, Error and
// Cancelled.

// "bundle": a design as it is on the disk, with the files that it reads.
Answer bundle_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);
// "unbundle": unpacks a bundle into a folder of its own.
Answer unbundle_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);
// "examples": names of the examples, with their first sentences.
Answer examples_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);
// "open_example": copies an example into a folder of its own.
Answer open_example_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);

}  // namespace ombre::studio
