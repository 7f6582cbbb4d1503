// Requests of the page to run a job of some kind.
#pragma once

#include <functional>

#include "studio/exports.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// Returns the kinds that the page offers, as a list of {"name", "help", "options"}. The options are in the format of
// options::describe, without the design.
DataList describe_kinds();

// Reads {"kind", "file", "options": {name: value}, "replace"}. Files among the options are in the workspace, and a
// study may be given as text. With "download": true the job writes into a temporary folder. `design` returns the open
// design. Throws RequestError.
ExportRequest kind_request(const Request& request, const Workspace& workspace,
                           const std::function<OpenDesignPtr()>& design);

}  // namespace ombre::studio
