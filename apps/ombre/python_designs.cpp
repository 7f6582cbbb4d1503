#include "ombre/python_designs.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/system/environment.h"
#include "ombre/command_line.h"
#include "ombre/console.h"

namespace ombre::cli {
namespace {

namespace fs = std::filesystem;

// True if the folder has the package with its compiled part; a build folder links the Python files before that is
// built.
bool holds_package(const fs::path& folder) {
  std::error_code ignored;
  const fs::directory_iterator files(folder / "ombre", ignored);
  return std::any_of(begin(files), end(files),
                     [](const auto& file) { return file.path().filename().string().starts_with("_core."); });
}

// Returns the folder of the package that was built or installed with this program; empty if Python finds it itself.
std::string package_folder() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  if (const fs::path built = program / "../../python"; holds_package(built)) return built.lexically_normal();
  for (const fs::path& python : fs::directory_iterator(program / "../lib", ignored)) {
    if (!python.filename().string().starts_with("python3")) continue;
    for (const char* packages : {"site-packages", "dist-packages"})
      if (holds_package(python / packages)) return (python / packages).lexically_normal();
  }
  return "";
}

std::string interpreter() {
  const std::string given = environment("OMBRE_PYTHON");
  return given.empty() ? OMBRE_PYTHON_PROGRAM : given;
}

// True for `run plan.json`, which makes a share of a plan.
bool names_plan(int argc, const char* const* argv) {
  return std::any_of(argv + 2, argv + argc, [](std::string_view word) { return word.ends_with(".json"); });
}

void put_first_on_path(const std::string& folder) {
  const std::string others = environment("PYTHONPATH");
  const std::string path = others.empty() ? folder : folder + ":" + others;
  ::setenv("PYTHONPATH", path.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): there is one thread
}

}  // namespace

bool needs_python(int argc, const char* const* argv) {
  if (argc > 1 && std::string_view(argv[1]) == "run") return !names_plan(argc, argv);
  if (argc > 1 && std::string_view(argv[1]) == "completion") return false;
  for (int n = 2; n < argc; ++n)
    if (const std::string_view word = argv[n]; word.ends_with(".py") && !word.starts_with("-")) return true;
  return false;
}

int become_python(int argc, char** argv) {
  const std::string folder = package_folder();
  if (!folder.empty()) put_first_on_path(folder);
  std::string python = interpreter();
  // Replaces Python's own message by a remedy if the package is missing.
  std::string program =
      "import sys\n"
      "try:\n"
      "    import ombre\n"
      "except ImportError as error:\n"
      "    sys.exit(f'ombre: error: designs in Python need the Python package ombre ({error}); install it with '\n"
      "             './dev install or pip install . in the sources of Ombre, or name another Python by OMBRE_PYTHON')\n"
      "from ombre.__main__ import main\n"
      "sys.exit(main(sys.argv[1:]))\n";
  std::string option = "-c";
  std::vector<char*> arguments{python.data(), option.data(), program.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  arguments.push_back(nullptr);
  ::execvp(python.c_str(), arguments.data());
  Console(Host()).error(Code::other_program, "designs in Python need Python: cannot run " + python + ": " +
                                                 std::generic_category().message(errno) +
                                                 "; OMBRE_PYTHON names another interpreter");
  return jobs::failed;
}

}  // namespace ombre::cli
