// Describes a loaded design for answers of the studio.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "base/text/data.h"
#include "studio/designs.h"

namespace ombre::studio {

// Describes the top-level variables of a script, with their comments and the places of their values in the text.
DataList describe_variables(const SourcePtr& source);

// Returns "design" (a handle), "bounds_mm", "materials", "parts", "part_nodes", "attributes", and "nodes" with their
// places in the text of the page.
DataMembers describe_design(const OpenDesign& design, const SourcePtr& page_text);

// Returns "type", and "from", "to" and "line" of its call if that is in the page's text.
DataMembers describe_call(const design::Node& node, const SourcePtr& page_text, const PageOffsets& offsets);

// Returns the nodes of a design as describe_design() numbers them: those of the parts first, then the nodes below them.
// Very deep or wide designs are listed in part.
std::vector<const design::Node*> listed_nodes(const design::Design& design);

// Returns the paths of the files that the nodes name.
std::set<std::string> design_files(const design::Design& design);

DataList list_of(Vec3 v);

}  // namespace ombre::studio
