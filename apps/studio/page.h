// The page that npm bundled, in builds that have it.
#pragma once

#include <span>

#include "studio/assets.h"

namespace ombre::studio {

std::span<const Asset> page_assets();

}  // namespace ombre::studio
