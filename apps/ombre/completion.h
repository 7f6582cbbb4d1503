// Finds words that may come next on a command line, for the completion of shells.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace ombre::cli {

struct Completion {
  std::string word, description;
};

// Returns words that complete the last of `words`, which follow the program's name. Returns none if names of files are
// possible, too.
std::vector<Completion> completions(const CLI::App& program, const std::vector<std::string>& words);

// Returns the script with which a shell asks `ombre completion words ...`; empty for an unknown shell.
std::string completion_script(const std::string& shell);
std::vector<std::string> completion_shells();

}  // namespace ombre::cli
