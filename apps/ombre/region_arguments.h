// How a design is cut into regions, and how finely: the arguments that meshes and contours share.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "compile/region_request.h"

namespace ombre::cli {

struct RegionArguments {
  std::string tolerance, cell, by, borders;
  int bands = 0;
};

// `piece` is what a region becomes: "A body".
void add_region_arguments(CLI::App& app, RegionArguments& arguments, const std::string& piece);

// Throws WrongArgument.
compile::RegionRequest region_request(const RegionArguments& arguments);

}  // namespace ombre::cli
