// Files with results of simulations, as commands take them.
#pragma once

#include <string>

#include "jobs/common/session.h"

namespace ombre::jobs {

// Does the name end like one of those files that hold a mesh: .vtu, .xdmf, .frd, .inp?
bool is_results(const std::string& path);
// Prints what one of these files holds; an exit code.
int show_results(const std::string& path, Session& session);
// A design that is the mesh of such a file, moved by its displacement times `deform`, with the field called `by` as an
// attribute of that name; empty: without one.
std::string results_as_script(const std::string& path, const std::string& by, double deform);

}  // namespace ombre::jobs
