// Searches for the best points of a problem whose functions are known only by their values.
#pragma once

#include <string>
#include <vector>

#include "optimise/problem.h"

namespace ombre::optimise {

// A method of a library, for one objective or several, with or without constraints.
struct Method {
  std::string name, library;
  bool many_objectives = false, takes_constraints = true;
};
// Returns the methods: cobyla (Powell, 1994), bobyqa (Powell, 2009) and direct (Jones et al., 1993; Gablonsky's
// DIRECT-L) by NLopt, nsga2 (Deb et al., 2002) and cmaes (Hansen, 2006) by pagmo.
const std::vector<Method>& methods();
const Method* find_method(const std::string& name);
// True if this build has the method's library; otherwise `search` throws Error.
bool is_built(const Method& method);

// Runs a search. Equal problems, options and outcomes ask for equal points in the same order, so an interrupted search
// continues if it is repeated with the known outcomes. Throws Error without the library.
void search(const Problem& problem, const SearchOptions& options);

}  // namespace ombre::optimise
