// What decides the pixels of a job: the arguments that slicing and its previews share.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "compile/load.h"
#include "ombre/commands.h"

namespace ombre::cli {

// Which design, and with what it is read.
struct DesignArguments {
  std::string design, materials;
  std::vector<std::string> definitions;
  std::vector<std::string> needed = {};  // variables that a command sets later, so that a script must have them
};
void add_design_arguments(CLI::App& app, DesignArguments& arguments);

struct JobArguments : DesignArguments {
  std::string printer, voxel, dpi, layer_height, dither = "stochastic", evaluator = "batch", seed = "0", image, place,
                                                 by, range, bits = "8";
  bool tray = false;
};

// Adds the design and the options that decide its voxels to a command.
void add_voxel_arguments(CLI::App& app, JobArguments& arguments);
// The same, and those that decide its images.
void add_job_arguments(CLI::App& app, JobArguments& arguments);

// Two numbers, the lesser first: "0,1".
Interval parse_range(const std::string& text);

// Nothing, and diagnostics, when there is no such printer. Throws WrongArgument.
std::optional<compile::PlanOptions> plan_options(const JobArguments& arguments, Diagnostics& diagnostics);

// On up to `threads` threads; 0: all cores. Null, and diagnostics, when the design is wrong.
compile::LoadedPtr load_design(const DesignArguments& arguments, Session& session, Diagnostics& diagnostics,
                               int threads = 0);

}  // namespace ombre::cli
