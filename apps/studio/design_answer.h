// Answers of the studio about a loaded design.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "base/text/data.h"
#include "studio/designs.h"

namespace ombre::studio {

// Returns the top-level variables of a script with the information in their comments, and the positions of their values
// in the text.
DataList describe_variables(const SourcePtr& source);

// Returns "design" (a handle), "bounds_mm", "materials", "parts", "part_nodes", "attributes" and "nodes", with their
// positions in the page's text.
DataMembers describe_design(const OpenDesign& design, const SourcePtr& page_text);

// Returns "type" and, if the call is in the page's text, its position: "from", "to", "line".
DataMembers describe_call(const design::Node& node, const SourcePtr& page_text, const PageOffsets& offsets);

// Returns the nodes of a design in the order in which describe_design() numbers them: the parts' nodes first, then
// those below. Very deep or wide designs are listed only in part.
std::vector<const design::Node*> listed_nodes(const design::Design& design);

// Returns the files that the design's nodes name, at the paths where they were found.
std::set<std::string> design_files(const design::Design& design);

DataList list_of(Vec3 v);

}  // namespace ombre::studio
