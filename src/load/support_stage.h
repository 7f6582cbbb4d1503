// A stage that finds the supports of a solid, from the top down.
#pragma once

#include "design/source_loader.h"

namespace ombre::compile {

// Makes the stage. Returns null, and adds diagnostics, when the solid has no bounds or would have too many cells.
design::StagePtr make_support_stage(const design::NodePtr& solid, const design::SupportUse& use,
                                    const design::Reader& reader);

}  // namespace ombre::compile
