// Words that may come next on a command line, for the shells' completion.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace ombre::cli {

struct Completion {
  std::string word, description;
};

// Words that complete the last of `words`, which follow the program's name. Empty where names of files are possible,
// too.
std::vector<Completion> completions(const CLI::App& program, const std::vector<std::string>& words);

// The script that has a shell ask `ombre completion words ...` for completions. Empty for a shell that is not known.
std::string completion_script(const std::string& shell);
std::vector<std::string> completion_shells();

}  // namespace ombre::cli
