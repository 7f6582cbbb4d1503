// What options accept, and what is said of the rest.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "options/option.h"

namespace ombre::cli {

CLI::Validator within(const options::Limits& limits);
// Numbers, ends included.
CLI::Validator between(double least, double greatest);
// Whole numbers.
CLI::Validator whole_between(int least, int greatest);
CLI::Validator one_of(const std::vector<std::string>& names);

}  // namespace ombre::cli
