// Requests of the page to run a job of some kind.
#pragma once

#include <functional>

#include "studio/exports.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// The kinds that the page offers, as a list of {"name", "help", "options"}, whose options are as options::describe has
// them, but for the design.
DataList describe_kinds();

// Reads {"kind", "file", "options": {name: value}, "replace"}: files among the options are in the workspace, and a
// study may be its text. `design` gives the open design. Throws RequestError.
ExportRequest kind_request(const Request& request, const Workspace& workspace,
                           const std::function<OpenDesignPtr()>& design);

}  // namespace ombre::studio
