// The options of ombre fea, as the command line gives them.
#pragma once

#include <string>
#include <vector>

#include "ombre/arguments.h"
#include "ombre/job_arguments.h"

namespace ombre::cli {

struct FeaArguments {
  DesignArguments design;
  std::vector<std::string> outputs;
  std::string study, elements = "brick", cell, size_by, subdomains, assign = "draw", modulus, conductivity,
                     element = "C3D8", solver = "auto", seed = "0", memory = "8G";
  std::string follow;
  double size = 0, min_cell = 0, max_cell = 0, tolerance = 1e-8, change = 1e-3;
  int threads = 0, sections = 64, rounds = 0;
  bool solve = false, force = false;
};

void add_arguments(CLI::App& app, FeaArguments& arguments);

// Throws WrongArgument where arguments do not fit each other, or a file is there that --force does not replace.
void check(const FeaArguments& arguments);

// The ending of a file's name in small letters, ".vtu".
std::string ending_of(const std::string& path);

// The file of HDF5 beside an .xdmf file.
std::string numbers_path(const std::string& path);

}  // namespace ombre::cli
