// Designs that are Python scripts: the same command line, inside of Python.
#pragma once

namespace ombre::cli {

// Does the command name a Python script?
bool needs_python(int argc, const char* const* argv);

// Becomes `python3 -m ombre` with the same arguments. Returns an exit code only when that fails, after it has reported
// why. OMBRE_PYTHON names another interpreter.
int become_python(int argc, char** argv);

}  // namespace ombre::cli
