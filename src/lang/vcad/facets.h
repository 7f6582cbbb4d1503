// Facets of round solids, as set by $fn.
#pragma once

#include "design/registry.h"
#include "lang/engine/vocabulary.h"

namespace ombre::lang {

// Replaces a round solid by the prism, pyramid or ball with flat faces that OpenSCAD makes for a small $fn. With many
// facets the node is returned unchanged, since a round solid is meant. Warns if $fn has no effect on the solid.
design::NodePtr with_facets(design::NodePtr round, const Invocation& call, const design::Registry& registry,
                            const design::Reader& reader);

}  // namespace ombre::lang
