// The commands there are. Each adds its arguments to the program and says what runs when it is named.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>

#include "base/system/progress.h"
#include "ombre/console.h"
#include "ombre/exit_codes.h"
#include "ombre/host.h"
#include "options/option.h"

namespace ombre::cli {

// What a command gets once its arguments are read.
struct Session {
  Console& console;
  const StopFlag& stop;
  DesignLoader load;
  sources::SourceCache& cache;  // of the files that designs name
};

// Returns an exit code.
using Action = std::function<int(Session&)>;

struct Command {
  CLI::App* app = nullptr;
  Action run;
  std::vector<options::Option> options = {};  // of a job; what the command has beside them is not among these
};

// Arguments wrong in a way that only the command can see; the message says what to write instead.
using WrongArgument = options::WrongValue;

// How much a command says; options that many commands have.
struct OutputOptions {
  bool quiet = false, json = false;
};
void add_output_options(CLI::App& app, OutputOptions& options);

Command add_slice(CLI::App& program, OutputOptions& output);
Command add_layer(CLI::App& program, OutputOptions& output);
Command add_render(CLI::App& program, OutputOptions& output);
Command add_voxels(CLI::App& program, OutputOptions& output);
Command add_mesh(CLI::App& program, OutputOptions& output);
Command add_contours(CLI::App& program, OutputOptions& output);
Command add_fea(CLI::App& program, OutputOptions& output);
Command add_homogenise(CLI::App& program, OutputOptions& output);
Command add_optimise(CLI::App& program, OutputOptions& output);
Command add_probe(CLI::App& program, OutputOptions& output);
Command add_sheet(CLI::App& program, OutputOptions& output);
Command add_info(CLI::App& program, OutputOptions& output);
Command add_nodes(CLI::App& program, OutputOptions& output);
Command add_codes(CLI::App& program, OutputOptions& output);
Command add_printers(CLI::App& program, OutputOptions& output);
Command add_materials(CLI::App& program, OutputOptions& output);
Command add_scad(CLI::App& program, OutputOptions& output);
Command add_bundle(CLI::App& program, OutputOptions& output);
Command add_studio(CLI::App& program, OutputOptions& output);
Command add_completion(CLI::App& program);

}  // namespace ombre::cli
