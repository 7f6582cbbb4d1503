// What stands under a solid that a printer builds layer by layer.
#pragma once

#include "design/source_loader.h"

namespace ombre::compile {

// As SourceLoader::support() has it. Null, and a diagnostic, when the solid has no bounds.
design::PendingSourcePtr make_support_source(const design::NodePtr& solid, const design::SupportUse& use,
                                             const design::Reader& reader);

}  // namespace ombre::compile
