// Designs that leave the folder and come into it with their files: bundles, and the examples that come with Ombre.
#pragma once

#include "base/system/progress.h"
#include "studio/workspace/studio_messages.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// Each answers one kind of request (docs/reference/studio-api.md). They throw RequestError, Error and Cancelled.

// "bundle": a design as it is on the disk, with what it reads.
Answer bundle_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);
// "unbundle": a bundle, unpacked into a folder of its own.
Answer unbundle_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);
// "examples": what they are called, and the sentence that each begins with.
Answer examples_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);
// "open_example": a copy of one, in a folder of its own.
Answer open_example_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);

}  // namespace ombre::studio
