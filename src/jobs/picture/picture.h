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

// Returns the point of the surface that the first frame of the picture shows at a pixel, or nothing if there is none or
// diagnostics were added. Throws Cancelled.
std::optional<Vec3> point_at_pixel(const Loaded& loaded, const PictureRequest& request, int64_t column, int64_t row,
                                   const StopFlag& stop, Diagnostics& diagnostics);

}  // namespace ombre::compile
