// What may stand next on a command line, for the shells' completion.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace ombre::cli {

struct Completion {
  std::string word, description;
};

// What may stand in place of the last of `words`, which follow the program's name, and begins as it does. Empty where
// the names of files may stand, too.
std::vector<Completion> completions(const CLI::App& program, const std::vector<std::string>& words);

// The script that has a shell ask `ombre completion words ...` for completions. Empty for a shell that is not known.
std::string completion_script(const std::string& shell);
std::vector<std::string> completion_shells();

}  // namespace ombre::cli
