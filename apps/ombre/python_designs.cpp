#include "ombre/python_designs.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "ombre/command_line.h"
#include "ombre/console.h"

namespace ombre::cli {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
  return value ? value : "";
}

// The package that was built or installed with this program; empty when it is Python's own.
std::string package_folder() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const fs::path& folder : {program / "../../python", program / "../lib/ombre/python"})
    if (fs::is_directory(folder / "ombre", ignored)) return folder.lexically_normal().string();
  return "";
}

std::string interpreter() {
  const std::string given = environment("OMBRE_PYTHON");
  return given.empty() ? OMBRE_PYTHON_PROGRAM : given;
}

void put_first_on_path(const std::string& folder) {
  const std::string others = environment("PYTHONPATH");
  const std::string path = others.empty() ? folder : folder + ":" + others;
  ::setenv("PYTHONPATH", path.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): there is one thread
}

}  // namespace

bool needs_python(int argc, const char* const* argv) {
  if (argc > 1 && std::string_view(argv[1]) == "run") return true;
  for (int n = 2; n < argc; ++n)
    if (const std::string_view word = argv[n]; word.ends_with(".py") && !word.starts_with("-")) return true;
  return false;
}

int become_python(int argc, char** argv) {
  const std::string folder = package_folder();
  if (!folder.empty()) put_first_on_path(folder);
  std::string python = interpreter();
  // Says what to do where the package is missing, in place of Python's own words.
  std::string program =
      "import sys\n"
      "try:\n"
      "    import ombre\n"
      "except ImportError as error:\n"
      "    sys.exit(f'ombre: error: designs in Python need the Python package ombre ({error}); install it with '\n"
      "             'pip install --no-build-isolation . in the sources of Ombre, or name another Python by "
      "OMBRE_PYTHON')\n"
      "from ombre.__main__ import main\n"
      "sys.exit(main(sys.argv[1:]))\n";
  std::string option = "-c";
  std::vector<char*> arguments{python.data(), option.data(), program.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  arguments.push_back(nullptr);
  ::execvp(python.c_str(), arguments.data());
  Console().error("designs in Python need Python: cannot run " + python + ": " +
                  std::generic_category().message(errno) + "; OMBRE_PYTHON names another interpreter");
  return failed;
}

}  // namespace ombre::cli
