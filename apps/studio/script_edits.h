// Answers of the studio about the graph of a script or a design file (JSON), which edits its text.
#pragma once

#include "base/system/progress.h"
#include "studio/workspace/studio_messages.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// Returns "ok", "diagnostics", and of a script without mistakes "items", "definitions" and "is_cut".
Answer script_graph_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);

// Returns "ok" and "diagnostics". An edit that was made also has "steps", lists of replacements, each of the text that
// the one before it has made; "made", the place of what was added; and the members of the new text's graph.
Answer edit_graph_answer(const Workspace& workspace, const Request& request, const StopFlag& stop);

}  // namespace ombre::studio
