// Loads the module of a method when it is first used.
#include "optimise/search.h"

#include "base/system/module_loader.h"
#include "base/text/error.h"
#include "optimise/search_calls.h"

namespace ombre::optimise {
namespace {

using Search = decltype(&ombre_search_nlopt);

constexpr Module nlopt{"ombre_nlopt",  "NLopt",       "the methods cobyla, bobyqa and direct",
                       "libnlopt-dev", "OMBRE_NLOPT", "choose another method"};
constexpr Module pagmo{"ombre_pagmo",  "pagmo",       "the methods nsga2 and cmaes",
                       "libpagmo-dev", "OMBRE_PAGMO", "choose another method"};

bool is_nlopt(const Method& method) { return method.library == "NLopt"; }

Search load_search(const Method& method) {
  return is_nlopt(method) ? load_function<decltype(ombre_search_nlopt)>(nlopt, "ombre_search_nlopt")
                          : load_function<decltype(ombre_search_pagmo)>(pagmo, "ombre_search_pagmo");
}

}  // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> list{{"cobyla", "NLopt", false, true},
                                        {"bobyqa", "NLopt", false, false},
                                        {"direct", "NLopt", false, true},
                                        {"nsga2", "pagmo", true, true},
                                        {"cmaes", "pagmo", false, true}};
  return list;
}

const Method* find_method(const std::string& name) {
  for (const Method& method : methods())
    if (method.name == name) return &method;
  return nullptr;
}

bool is_built(const Method& method) { return has_module(is_nlopt(method) ? nlopt : pagmo); }

void search(const Problem& problem, const SearchOptions& options) {
  const Method* const method = find_method(options.method);
  if (!method) throw Error(Code::option, "there is no method \"" + options.method + "\"");
  load_search (*method)(&problem, &options);
}

}  // namespace ombre::optimise
