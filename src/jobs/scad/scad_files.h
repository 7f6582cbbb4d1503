// Writes the solids of a script for `ombre scad`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/packages/package_writers.h"
#include "jobs/common/session.h"
#include "lang/openscad/script_messages.h"
#include "solids/tree.h"

namespace ombre::jobs {

// Returns the endings that the command writes, also ".echo" and similar ones.
std::vector<std::string> scad_formats();
// True if the format is one of solids or areas: a mesh, or a drawing.
bool writes_solids(const std::string& format);
struct SolidsOutput {
  std::vector<std::string> paths;  // the ending of each says its format; "{part}" makes a file for each part
  bool no_overlap = false;         // the first solid keeps the space
  formats::SlicerFlavour flavour = formats::SlicerFlavour::generic;
};

// Writes the tree's solids or areas to all paths. Returns the files, or nothing, with diagnostics among the events, if
// they do not fit the format. Warnings of the geometry go to `said`.
std::optional<std::vector<std::string>> write_solids(const solids::TreePtr& tree, const SolidsOutput& output,
                                                     lang::openscad::Messages& said, Session& session);

// Writes the solids of a script that is a design; its surfaces are meshed within the usual tolerance of `ombre mesh`.
std::optional<std::vector<std::string>> write_design(const compile::LoadedPtr& loaded, const SolidsOutput& output,
                                                     Session& session);

}  // namespace ombre::jobs
