// The stage that finds, from the top down, what must stand under a solid while it is printed.
#pragma once

#include "design/source_loader.h"

namespace ombre::compile {

// Null, and diagnostics, when the solid has no bounds or would have too many cells.
design::StagePtr make_support_stage(const design::NodePtr& solid, const design::SupportUse& use,
                                    const design::Reader& reader);

}  // namespace ombre::compile
