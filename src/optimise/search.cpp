// Loads the module of a method when it is first used.
#include "optimise/search.h"

#include "base/error.h"
#include "base/module_loader.h"
#include "optimise/module.h"

namespace ombre::optimise {
namespace {

using Search = decltype(&ombre_search_nlopt);

#ifdef OMBRE_NLOPT_MODULE
constexpr const char* nlopt_module = OMBRE_NLOPT_MODULE;
#else
constexpr const char* nlopt_module = nullptr;
#endif
#ifdef OMBRE_PAGMO_MODULE
constexpr const char* pagmo_module = OMBRE_PAGMO_MODULE;
#else
constexpr const char* pagmo_module = nullptr;
#endif

bool is_nlopt(const Method& method) { return method.library == "NLopt"; }

Search load_search(const Method& method) {
  if (!is_built(method))
    throw Error(Code::library_missing, "this ombre was built without " + method.library + ", which the method " +
                                           method.name + " needs; install " +
                                           (is_nlopt(method) ? "libnlopt-dev" : "libpagmo-dev") + ", configure with " +
                                           (is_nlopt(method) ? "-DOMBRE_NLOPT=ON" : "-DOMBRE_PAGMO=ON") +
                                           " and build again, or choose another method");
  if (is_nlopt(method))
    return load_function<decltype(ombre_search_nlopt)>(nlopt_module, "ombre_search_nlopt", "methods of NLopt");
  return load_function<decltype(ombre_search_pagmo)>(pagmo_module, "ombre_search_pagmo", "methods of pagmo");
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

bool is_built(const Method& method) { return (is_nlopt(method) ? nlopt_module : pagmo_module) != nullptr; }

void search(const Problem& problem, const SearchOptions& options) {
  const Method* const method = find_method(options.method);
  if (!method) throw Error(Code::option, "there is no method \"" + options.method + "\"");
  load_search (*method)(&problem, &options);
}

}  // namespace ombre::optimise
