// Checks of options' values, and their messages.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "options/option.h"

namespace ombre::cli {

CLI::Validator within(const options::Limits& limits);
// Accepts numbers from `least` to `greatest`, ends included.
CLI::Validator between(double least, double greatest);
// Accepts integers from `least` to `greatest`, ends included.
CLI::Validator whole_between(int least, int greatest);
CLI::Validator one_of(const std::vector<std::string>& names);

}  // namespace ombre::cli
