// Modules with heavy libraries, which are loaded when they are first needed. A build may lack them.
#pragma once

#include <string>

namespace ombre {

// Describes a module. Each use of a module defines one, beside the code that uses it.
struct Module {
  const char* name;      // CMake target; the file is lib<name>.so
  const char* library;   // library that the module calls
  const char* what;      // what needs the library, in the plural: "DICOM files"
  const char* packages;  // Debian's packages of the library
  const char* option;    // CMake option that enables the module
  const char* instead;   // what a user can do without the module
};

bool has_module(const Module& module);

// Returns the message for a missing module: "this ombre was built without GDCM, which DICOM files need; ..."
std::string without(const Module& module);

// Returns a function of a library by its C name. Throws Error: "`what` need `path`, which cannot be loaded".
void* load_symbol(const std::string& path, const char* function, const std::string& what);

// Returns a function of a module, which is sought beside this code, where modules are installed, and in the build
// folder. Throws Error with the text of without() if the module is missing.
void* load_symbol(const Module& module, const char* function);

template <class Function>
Function* load_function(const Module& module, const char* function) {
  return reinterpret_cast<Function*>(load_symbol(module, function));  // NOLINT
}

}  // namespace ombre
