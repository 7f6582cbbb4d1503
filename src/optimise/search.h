// Searches for the best points of a problem whose functions are only known by their values.
#pragma once

#include <string>
#include <vector>

#include "optimise/problem.h"

namespace ombre::optimise {

// A method of a library: for one objective or for several, and whether with constraints.
struct Method {
  std::string name, library;
  bool many_objectives = false, takes_constraints = true;
};
// cobyla (Powell, 1994), bobyqa (Powell, 2009), direct (Jones et al., 1993; Gablonsky's DIRECT-L), by NLopt;
// nsga2 (Deb et al., 2002), cmaes (Hansen, 2006), by pagmo.
const std::vector<Method>& methods();
const Method* find_method(const std::string& name);
// Whether this build has the method's library; else `search` throws Error.
bool is_built(const Method& method);

// The same problem, options and outcomes ask for the same points in the same order, so a search that was interrupted
// goes on when it is repeated with the outcomes that are known. Throws Error without the library.
void search(const Problem& problem, const SearchOptions& options);

}  // namespace ombre::optimise
