// What $fn asks of round solids.
#pragma once

#include "design/registry.h"
#include "lang/engine/vocabulary.h"

namespace ombre::lang {

// The prism, pyramid or ball of flat faces that OpenSCAD makes where $fn is small, in place of a round solid. With many
// facets a round solid is meant, and the node stays as it is. A warning where $fn cannot do what it asks for.
design::NodePtr with_facets(design::NodePtr round, const Invocation& call, const design::Registry& registry,
                            const design::Reader& reader);

}  // namespace ombre::lang
