// Runs the command line inside of Python if the design is a Python script.
#pragma once

namespace ombre::cli {

// True if the command names a Python script.
bool needs_python(int argc, const char* const* argv);

// Becomes `python3 -m ombre` with the same arguments. Returns an exit code only if that fails, after it has reported
// why. OMBRE_PYTHON names another interpreter.
int become_python(int argc, char** argv);

}  // namespace ombre::cli
