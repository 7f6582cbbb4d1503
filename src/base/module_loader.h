// Code with heavy libraries, which is loaded when it is first needed.
#pragma once

#include <string>

#include "base/error.h"

namespace ombre {

// A function of a module by its C name. `built` is the module's path where it was built; it is looked for beside this
// code and where it is installed first. Throws Error: "`what` need ..., which cannot be loaded".
void* load_symbol(const std::string& built, const char* function, const std::string& what);

template <class Function>
Function* load_function(const std::string& built, const char* function, const std::string& what) {
  return reinterpret_cast<Function*>(load_symbol(built, function, what));  // NOLINT
}

// The same for a library that builds may lack: `built` is null then, and an Error with the text `without` is thrown.
template <class Function>
Function* load_function(const char* built, const char* function, const std::string& what, const char* without) {
  if (!built) throw Error(Code::library_missing, without);
  return load_function<Function>(built, function, what);
}

}  // namespace ombre
