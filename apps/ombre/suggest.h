// Explains arguments that do not fit.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace ombre::cli {

// Returns one or two lines about a mistake that CLI11 found: what is wrong and what was probably meant.
std::string explain(const CLI::App& program, const CLI::ParseError& error);

// Explains a first argument that names no command; empty if it names one or is an option.
std::string unknown_command(const CLI::App& program, const std::string& argument);

}  // namespace ombre::cli
