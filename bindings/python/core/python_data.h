// Converts Python's values to plain data, and back.
#pragma once

#include <pybind11/pybind11.h>

#include "base/text/data.h"
#include "base/text/diagnostic.h"

namespace ombre::python {

namespace py = pybind11;

// Converts None, numbers, texts, lists, tuples, arrays and callables. Raises TypeError, naming `what`, for anything
// else.
Data to_data(const py::handle& value, const SourceRange& where, const std::string& what);
py::object to_python(const Data& data);
py::dict to_python(const DataMembers& members);

// Returns the line of the user's code that is running: the innermost frame outside of this package.
SourceRange call_site();
SourceRange line_of(const std::string& file, int number);
// Sets the folder whose code counts as the package's own.
void set_package_folder(const std::string& folder);

// Returns [{"severity", "message", "hint", "file", "line", "column"}].
py::list to_python(const Diagnostics& diagnostics);
// Raises DesignError when there are errors; warnings become Python's.
void raise_errors(const Diagnostics& diagnostics);
// Returns the Python class of that name in the package; the interpreter owns it.
py::object package_member(const char* name);

}  // namespace ombre::python
