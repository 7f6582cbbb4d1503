// Code with heavy libraries, which stands in modules that are loaded when they are first needed. A build may lack them.
#pragma once

#include <string>

namespace ombre {

// One row for each use, beside the code that uses it.
struct Module {
  const char* name;      // CMake's target, whose file is lib<name>.so
  const char* library;   // which it calls
  const char* what;      // which needs it, in the plural: "DICOM files"
  const char* packages;  // Debian's
  const char* option;    // CMake's
  const char* instead;   // what a person may do without it
};

bool has_module(const Module& module);

// "this ombre was built without GDCM, which DICOM files need; ..."
std::string without(const Module& module);

// A function of a library by its C name. Throws Error: "`what` need `path`, which cannot be loaded".
void* load_symbol(const std::string& path, const char* function, const std::string& what);

// Finds a function in a module, which lies beside this code, where it is installed, or in the build folder. Throws
// Error with without() where the module is missing.
void* load_symbol(const Module& module, const char* function);

template <class Function>
Function* load_function(const Module& module, const char* function) {
  return reinterpret_cast<Function*>(load_symbol(module, function));  // NOLINT
}

}  // namespace ombre
