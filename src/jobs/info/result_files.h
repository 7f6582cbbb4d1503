// Handles files with results of simulations, as commands take them.
#pragma once

#include <string>

#include "jobs/common/session.h"
#include "jobs/info/info_choices.h"

namespace ombre::jobs {

// True if the name ends like a file that holds a mesh: .vtu, .xdmf, .frd, .inp.
bool is_results(const std::string& path);
// Prints the contents of such a file; returns an exit code.
int show_results(const InfoChoices& choices, Session& session);
// Returns a script of the mesh in a step of such a file, 0 for the last, moved by its displacement times `deform`. The
// field called `by` becomes an attribute of that name; empty: none.
std::string results_as_script(const std::string& path, const std::string& by, double deform, int step);

}  // namespace ombre::jobs
