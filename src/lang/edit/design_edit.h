// Edits of a design file (JSON) by its graph, each of which is an edit of its text. The layout of the rest stays.
#pragma once

#include "lang/edit/design_graph.h"
#include "lang/edit/graph_edit.h"

namespace ombre::lang {

// Makes an edit. Items are named by their numbers in the DesignGraph, and values are JSON. What is added is a node:
// {"type": "sphere", "parameters": {"radius": 5}}, or the name of its type. AddVariable adds a node with this id that
// nothing uses yet. RenameVariable renames a node or a part. Removing a node removes those that only it takes, too.
// Returns nothing, with the reason in the diagnostics, if the text is no design file, or the edit cannot be made:
// design files have neither modules nor libraries.
std::optional<EditedScript> edit_design(const SourcePtr& file, const GraphEdit& edit, Diagnostics& diagnostics);

}  // namespace ombre::lang
