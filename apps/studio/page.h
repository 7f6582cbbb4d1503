// The page as bundled by npm, in builds that include it.
#pragma once

#include <span>

#include "studio/assets.h"

namespace ombre::studio {

std::span<const Asset> page_assets();

}  // namespace ombre::studio
