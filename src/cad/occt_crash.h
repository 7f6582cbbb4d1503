// Broken files make Open CASCADE follow null pointers. Only for this folder.
#pragma once

#include <functional>

namespace ombre::cad {

// Calls f. False when it did not come back, since it touched memory that is not there; what it held is lost. One at a
// time; other threads are not affected.
bool survives(const std::function<void()>& f);

}  // namespace ombre::cad
