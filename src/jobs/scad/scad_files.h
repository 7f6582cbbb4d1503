// Writes the solids of a script for `ombre scad`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jobs/common/session.h"
#include "lang/openscad/script_messages.h"
#include "solids/tree.h"

namespace ombre::jobs {

// Returns the endings that the command writes, also ".echo" and similar ones.
std::vector<std::string> scad_formats();
// True if the format is one of solids or areas: a mesh, or a drawing.
bool writes_solids(const std::string& format);
// Writes the tree's solids or areas to all paths, each in the format of its ending; "{part}" in a path makes a file for
// each part. Returns the files, or nothing, with diagnostics among the events, if they do not fit the format. Warnings
// of the geometry go to `said`.
std::optional<std::vector<std::string>> write_solids(const solids::TreePtr& tree, const std::vector<std::string>& paths,
                                                     bool no_overlap, lang::openscad::Messages& said, Session& session);

// Writes the solids of a script that is a design; its surfaces are meshed within the usual tolerance of `ombre mesh`.
std::optional<std::vector<std::string>> write_design(const compile::LoadedPtr& loaded,
                                                     const std::vector<std::string>& paths, bool no_overlap,
                                                     Session& session);

}  // namespace ombre::jobs
