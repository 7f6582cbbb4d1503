// Takes pictures of a design.
#pragma once

#include <functional>

#include "base/system/progress.h"
#include "jobs/picture/picture_request.h"
#include "load/loaded.h"

namespace ombre::compile {

// Calls `take` with each frame; progress counts rows of all frames. Returns false, and adds diagnostics, when there is
// nothing to see. Throws Cancelled, and Error if annotations cannot be drawn or memory does not suffice.
bool take_pictures(const Loaded& loaded, const PictureRequest& request, const StopFlag& stop,
                   const std::function<void(int frame, const Picture&)>& take, Diagnostics& diagnostics,
                   Progress* progress = nullptr);

}  // namespace ombre::compile
