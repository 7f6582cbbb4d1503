// Answers of the studio about a design that was loaded.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "base/text/data.h"
#include "studio/designs.h"

namespace ombre::studio {

// Top-level variables of a script with what its comments say of them, and where their values stand in the text.
DataList describe_variables(const SourcePtr& source);

// "design" (a handle), "bounds_mm", "materials", "parts", "part_nodes", "attributes", "nodes", with their places in the
// text that the page has.
DataMembers describe_design(const OpenDesign& design, const SourcePtr& page_text);

// "type", and where its call stands in the page's text: "from", "to", "line", if it does.
DataMembers describe_call(const design::Node& node, const SourcePtr& page_text, const PageOffsets& offsets);

// The nodes of a design as describe_design() numbers them: the parts' first, and then those below them. Deeper or wider
// designs are listed in part.
std::vector<const design::Node*> listed_nodes(const design::Design& design);

// The files that its nodes name, where they were found.
std::set<std::string> design_files(const design::Design& design);

DataList list_of(Vec3 v);

}  // namespace ombre::studio
